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

/// Writes the summary when the run ends, for programs (summary_json) and for people (summary_text), each file
/// atomically.
class SummarySink final : public Sink {
 public:
  SummarySink(std::filesystem::path json, std::filesystem::path text)
      : json_(std::move(json)), text_(std::move(text)) {}
  /// Throws OutputError.
  void finish(const Summary& summary) override;

 private:
  std::filesystem::path json_, text_;
};

}  // namespace breccia
