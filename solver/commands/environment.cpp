#include "commands/environment.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "base/error.hpp"
#include "physics/sweep.hpp"

namespace breccia {
namespace {

/// MPI starts processes of its own and ParaView's adaptor is loaded in 256 KiB, not in 192; twice that is required.
constexpr rlim_t kLeastStack = rlim_t{512} << 10;
/// What systems give by default.
constexpr rlim_t kUsualStack = rlim_t{8} << 20;

}  // namespace

std::string stack_problem() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kUsualStack) return {};
  limit.rlim_cur = std::min(limit.rlim_max, kUsualStack);
  if (::setrlimit(RLIMIT_STACK, &limit) != 0) (void)::getrlimit(RLIMIT_STACK, &limit);
  if (limit.rlim_cur >= kLeastStack) return {};
  const Problem problem{"",
                        0,
                        "the limit of the stack (ulimit -s)",
                        "is too low",
                        fmt::format("at least {} KiB", kLeastStack >> 10),
                        fmt::format("{} KiB", limit.rlim_cur >> 10)};
  return problem.text();
}

void check_environment() {
  const char* simd = std::getenv("BRECCIA_SIMD");
  if (simd == nullptr || *simd == '\0') return;
  for (const Simd known : {Simd::sse2, Simd::avx2, Simd::avx512}) {
    if (std::string(simd) == name_of(known)) return;
  }
  throw InputError(Problem{"", 0, "BRECCIA_SIMD", "is no instruction set", "sse2, avx2, avx512, or not set", simd});
}

}  // namespace breccia
