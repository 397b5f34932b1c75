#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <random>
#include <string>
#include <thread>

#include "output/folder/run_folder.hpp"
#include "system/sha256.hpp"

namespace breccia {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "";
  return name.data();
}

std::string processor_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(':');
    if (line.starts_with("model name") && colon != std::string::npos && colon + 2 <= line.size())
      return line.substr(colon + 2);
  }
  return "";
}

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return {text.data(), length};
}

/// 128 bits, so that no two runs have the same.
std::string random_name() {
  std::random_device source;
  std::array<char, 36> text{};
  std::snprintf(text.data(), text.size(), "%08x%08x%08x%08x", source(), source(), source(), source());
  return text.data();
}

}  // namespace

Provenance::Input input_file(const std::filesystem::path& file) { return {file.string(), sha256_of_file(file)}; }

Provenance collect_provenance(std::string version, std::vector<std::string> command_line) {
  Provenance provenance;
  provenance.run = random_name();
  provenance.version = std::move(version);
  provenance.host = host_name();
  provenance.processor = processor_model();
  provenance.cores = static_cast<int>(std::thread::hardware_concurrency());
  provenance.commit = BRECCIA_COMMIT;
  provenance.libraries = BRECCIA_LIBRARIES;
  provenance.compiler = BRECCIA_COMPILER;
  provenance.flags = BRECCIA_FLAGS;
  provenance.started = utc_now();
  provenance.command_line = std::move(command_line);
  return provenance;
}

}  // namespace breccia
