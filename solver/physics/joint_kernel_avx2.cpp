#include "physics/joint_kernel.hpp"

namespace breccia {

void joint_block_avx2(const JointLawParams& law, const double* position, JointBlock& block) {
  act_block(law, position, block);
}

}  // namespace breccia
