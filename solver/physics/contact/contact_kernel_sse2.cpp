#include "physics/contact/contact_kernel.hpp"

namespace breccia {

ContactKernels contact_kernels_sse2() { return {locate_block, press_block}; }

}  // namespace breccia
