#include "physics/contact/contact_kernel.hpp"

namespace breccia {

ContactKernels contact_kernels_avx512() { return {locate_block, press_block}; }

}  // namespace breccia
