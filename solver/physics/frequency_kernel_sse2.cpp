#include "physics/frequency_kernel.hpp"

namespace breccia {

void frequency_block_sse2(const FrequencyGroup& group, const double* corners, const double* gradient, double* out) {
  frequency_block(group, corners, gradient, out);
}

}  // namespace breccia
