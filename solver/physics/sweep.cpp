#include "physics/sweep.hpp"

#include <cstdlib>
#include <string_view>

#include "base/error.hpp"

namespace breccia {

SweepStatus sweep_sse2(const SweepArgs& args);
SweepStatus sweep_avx2(const SweepArgs& args);
SweepStatus sweep_avx512(const SweepArgs& args);
void rate_work_sse2(const SweepArgs& args);
void rate_work_avx2(const SweepArgs& args);
void rate_work_avx512(const SweepArgs& args);

std::string_view name_of(Simd simd) {
  switch (simd) {
    case Simd::sse2:
      return "sse2";
    case Simd::avx2:
      return "avx2";
    case Simd::avx512:
      return "avx512";
  }
  return "";
}

bool simd_available(Simd simd) {
  switch (simd) {
    case Simd::sse2:
      return true;
    case Simd::avx2:
      return __builtin_cpu_supports("avx2");
    case Simd::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("bmi2");
  }
  return false;
}

Simd best_simd() {
  const char* asked = std::getenv("BRECCIA_SIMD");
  for (const Simd simd : {Simd::avx512, Simd::avx2}) {
    if (asked != nullptr && name_of(simd) != asked) continue;
    if (simd_available(simd)) return simd;
  }
  return Simd::sse2;
}

SweepFunction sweep_for(Simd simd) {
  DEMAND(simd_available(simd), std::string(name_of(simd)));
  switch (simd) {
    case Simd::avx512:
      return sweep_avx512;
    case Simd::avx2:
      return sweep_avx2;
    case Simd::sse2:
      break;
  }
  return sweep_sse2;
}

RateWorkFunction rate_work_for(Simd simd) {
  DEMAND(simd_available(simd), std::string(name_of(simd)));
  switch (simd) {
    case Simd::avx512:
      return rate_work_avx512;
    case Simd::avx2:
      return rate_work_avx2;
    case Simd::sse2:
      break;
  }
  return rate_work_sse2;
}

}  // namespace breccia
