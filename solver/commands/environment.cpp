#include "commands/environment.hpp"

#include <cstdlib>
#include <string>

#include "base/error.hpp"
#include "physics/sweep.hpp"

namespace breccia {

void check_environment() {
  const char* simd = std::getenv("BRECCIA_SIMD");
  if (simd == nullptr || *simd == '\0') return;
  for (const Simd known : {Simd::sse2, Simd::avx2, Simd::avx512}) {
    if (std::string(simd) == name_of(known)) return;
  }
  throw InputError(Problem{"", 0, "BRECCIA_SIMD", "is no instruction set", "sse2, avx2, avx512, or not set", simd});
}

}  // namespace breccia
