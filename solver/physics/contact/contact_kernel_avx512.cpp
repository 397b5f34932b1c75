#include "physics/contact/contact_kernel.hpp"

namespace breccia {

ContactKernels contact_kernels_avx512() { return {look_block, press_block}; }

}  // namespace breccia
