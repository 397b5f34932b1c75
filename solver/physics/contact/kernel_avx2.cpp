#include "physics/contact/kernel.hpp"

namespace breccia {

ContactKernels contact_kernels_avx2() { return contact_kernels<NativeReal>(); }

}  // namespace breccia
