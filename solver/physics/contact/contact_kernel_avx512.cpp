#include "physics/contact/contact_kernel.hpp"

namespace breccia {

void press_block_avx512(double dt, const double* velocity, ContactBlock& block) { press_block(dt, velocity, block); }

}  // namespace breccia
