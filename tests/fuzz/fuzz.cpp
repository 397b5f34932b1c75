// Feeds mutated bytes to the readers: fuzz TARGET|all SECONDS [SEED]. Prints executions; ends with 1 at the first
// finding, whose bytes it leaves in fuzz_TARGET.bin, a crash and an execution of more than ten seconds included.
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <random>
#include <string>

#include "base/error.hpp"
#include "fuzz/targets.hpp"

namespace breccia::fuzz {
namespace {

using Bytes = std::vector<std::byte>;
constexpr unsigned kSlowest = 10;  // s an execution may take

/// Words and numbers that readers trip over.
constexpr const char* kWords[] = {"[[",
                                  "]]",
                                  "{",
                                  "}",
                                  "=",
                                  "\"\"\"",
                                  "'''",
                                  "\n",
                                  ".",
                                  "-1",
                                  "nan",
                                  "inf",
                                  "1e309",
                                  "99999999999999999999",
                                  "[mesh.raster]",
                                  "[[stage]]",
                                  "e-",
                                  "\\u0000",
                                  "(",
                                  "/*",
                                  "DefineConstant[",
                                  "Include \"",
                                  " id=",
                                  "function",
                                  "GPa",
                                  "\xc2\xb5"};

// Of the execution in progress, for the handler of a crash.
const Bytes* present = nullptr;
const char* present_target = "";

void keep_present() {
  std::ofstream(std::string("fuzz_") + present_target + ".bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(present->data()), static_cast<std::streamsize>(present->size()));
}

/// The process is lost: what led here is worth more than the rules for handlers.
void on_crash(int signal) {
  keep_present();
  std::fprintf(stderr, "finding: signal %d in target %s; the bytes are in fuzz_%s.bin\n", signal, present_target,
               present_target);
  ::_exit(1);
}

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  Bytes of(const std::vector<Bytes>& seeds) {
    Bytes bytes = seeds[below(seeds.size())];
    for (std::size_t changes = 1 + below(8); changes > 0; --changes) change(bytes, seeds);
    return bytes;
  }
  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }

 private:
  void change(Bytes& bytes, const std::vector<Bytes>& seeds) {
    const std::size_t at = below(bytes.size() + 1), rest = bytes.size() - at;
    const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    switch (below(7)) {
      case 0:
        if (rest > 0) bytes[at] ^= static_cast<std::byte>(1U << below(8));
        return;
      case 1:
        if (rest > 0) bytes[at] = static_cast<std::byte>(below(256));
        return;
      case 2:
        bytes.erase(place, place + static_cast<std::ptrdiff_t>(below(std::min<std::size_t>(rest, 64) + 1)));
        return;
      case 3: {
        const std::string word = kWords[below(std::size(kWords))];
        const auto raw = std::as_bytes(std::span(word));
        bytes.insert(place, raw.begin(), raw.end());
        return;
      }
      case 4: {  // a piece of another seed
        const Bytes& other = seeds[below(seeds.size())];
        const std::size_t from = below(other.size() + 1),
                          size = below(std::min<std::size_t>(other.size() - from, 200) + 1);
        const Bytes piece(other.begin() + static_cast<std::ptrdiff_t>(from),
                          other.begin() + static_cast<std::ptrdiff_t>(from + size));
        bytes.insert(place, piece.begin(), piece.end());
        return;
      }
      case 5:
        bytes.resize(at);
        return;
      default: {  // one piece many times over
        const Bytes piece(place, place + static_cast<std::ptrdiff_t>(std::min<std::size_t>(rest, 1 + below(8))));
        for (std::size_t times = below(100); times > 0 && bytes.size() < 100000; --times)
          bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), piece.begin(), piece.end());
      }
    }
  }

  std::mt19937_64 random_;
};

/// @return  executions, or -1 at a finding
long campaign(const Target& target, double seconds, std::uint64_t seed) {
  const std::vector<Bytes> seeds = target.seeds();
  Mutator mutator(seed);
  present_target = target.name;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  long executions = 0;
  for (; std::chrono::steady_clock::now() < end; ++executions) {
    const Bytes bytes =
        executions < static_cast<long>(seeds.size()) ? seeds[static_cast<std::size_t>(executions)] : mutator.of(seeds);
    present = &bytes;
    ::alarm(kSlowest);
    try {
      target.run(bytes);
    } catch (const InputError&) {
    } catch (const std::exception& error) {
      keep_present();
      std::fprintf(stderr, "finding: %s in target %s; the bytes are in fuzz_%s.bin\n", error.what(), target.name,
                   target.name);
      return -1;
    }
  }
  ::alarm(0);
  return executions;
}

}  // namespace
}  // namespace breccia::fuzz

int main(int argc, char** argv) {
  using namespace breccia::fuzz;
  const std::string wanted = argc > 1 ? argv[1] : "all";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 10;
  const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  static char stack[1 << 16];
  const stack_t other{stack, 0, sizeof stack};
  ::sigaltstack(&other, nullptr);  // a stack that has run over leaves no room for the handler
  for (const int s : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGALRM}) {
    struct sigaction action {};
    action.sa_handler = on_crash;
    action.sa_flags = SA_ONSTACK;
    ::sigaction(s, &action, nullptr);
  }
  int findings = 0, ran = 0;
  for (const Target& target : targets()) {
    if (wanted != "all" && wanted != target.name) continue;
    ++ran;
    const long executions = campaign(target, seconds, seed);
    findings += executions < 0 ? 1 : 0;
    std::printf("%-9s %ld executions\n", target.name, executions);
  }
  return findings > 0 || ran == 0 ? 1 : 0;
}
