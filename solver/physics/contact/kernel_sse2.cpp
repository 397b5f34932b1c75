#include "physics/contact/kernel.hpp"

namespace breccia {

ContactKernels contact_kernels_sse2() { return contact_kernels<NativeReal>(); }

}  // namespace breccia
