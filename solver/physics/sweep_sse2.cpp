#include "physics/sweep_kernel.hpp"

namespace breccia {

SweepStatus sweep_sse2(const SweepArgs& args) { return sweep(args); }
void rate_work_sse2(const SweepArgs& args) { account_rate_work(args); }

}  // namespace breccia
