// The same readers under libFuzzer, which finds by coverage what mutations of a sound file do not reach, a target a
// process: fuzz_guided --target=NAME FOLDER [options of libFuzzer]; --seeds=FOLDER writes what is accepted, to begin
// from, and ends.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "fuzz/targets.hpp"

namespace {

const breccia::fuzz::Target* chosen = nullptr;

void write_seeds(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  int number = 0;
  for (const auto& seed : chosen->seeds()) {
    std::ofstream(folder / ("seed_" + std::to_string(number++)), std::ios::binary)
        .write(reinterpret_cast<const char*>(seed.data()), static_cast<std::streamsize>(seed.size()));
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  std::string seeds;
  for (int i = 1; i < *argc; ++i) {
    const std::string_view word = (*argv)[i];
    if (word.starts_with("--seeds=")) seeds = word.substr(8);
    if (!word.starts_with("--target=")) continue;
    for (const breccia::fuzz::Target& target : breccia::fuzz::targets())
      if (word.substr(9) == target.name) chosen = &target;
  }
  if (chosen == nullptr) {
    std::fputs("fuzz_guided: --target=NAME is missing; the names are those that 'fuzz all' prints\n", stderr);
    std::exit(1);
  }
  if (!seeds.empty()) {
    write_seeds(seeds);
    std::exit(0);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    chosen->run({reinterpret_cast<const std::byte*>(data), size});
  } catch (const breccia::InputError&) {
  }
  return 0;
}
