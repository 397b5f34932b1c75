#include "physics/sweep_kernel.hpp"

namespace breccia {

SweepStatus sweep_avx2(const SweepArgs& args) { return sweep(args); }

}  // namespace breccia
