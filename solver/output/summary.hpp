#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "output/sink.hpp"

namespace breccia {

/// The summary as JSON, fields named as the members of Summary and EnergyBudget; energy_residual_relative stands beside
/// "energy". Numbers that are not finite are null.
[[nodiscard]] std::string summary_json(const Summary& summary);

/// The same for a terminal: aligned lines, units people use, phases and energies by share. Ends with a line feed.
[[nodiscard]] std::string summary_text(const Summary& summary);

/// Largest resident memory of this process so far, bytes.
[[nodiscard]] std::uint64_t max_resident_bytes();

/// Writes `summary.json` when the run ends, atomically.
class SummarySink final : public Sink {
 public:
  explicit SummarySink(std::filesystem::path file) : path_(std::move(file)) {}
  /// Throws OutputError.
  void finish(const Summary& summary) override;

 private:
  std::filesystem::path path_;
};

}  // namespace breccia
