#include "physics/number_vector.hpp"

#include <Eigen/Geometry>

#include "physics/contact/kernel.hpp"

namespace breccia {

ContactKernels contact_kernels_scalar() { return contact_kernels<double>(); }

}  // namespace breccia
