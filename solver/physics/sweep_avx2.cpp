#include "physics/sweep_kernel.hpp"

namespace breccia {

SweepStatus sweep_avx2(const SweepArgs& args) { return sweep(args); }
void rate_work_avx2(const SweepArgs& args) { account_rate_work(args); }

}  // namespace breccia
