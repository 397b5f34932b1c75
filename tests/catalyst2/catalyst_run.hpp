#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "end_to_end/program.hpp"

namespace breccia::test {

/// Override that chooses the back end.
inline const std::string kBackend = " --set insitu.backend=catalyst2 ";

/// A run of the small case over Catalyst 2, with a libcatalyst of our own that writes down what it is given.
struct CatalystRun {
  /// @param more  NAME=VALUE ..., of its environment
  CatalystRun(int ranks, const std::string& arguments, const std::string& more = "");
  /// Goes on to its end.
  [[nodiscard]] Outcome resumed(int ranks, const std::string& arguments) const;
  [[nodiscard]] std::filesystem::path folder() const { return scratch.path("run"); }
  [[nodiscard]] nlohmann::json summary() const { return nlohmann::json::parse(read_text(folder() / "summary.json")); }
  /// Lines of the cells that a rank was given, in the order in which it was.
  [[nodiscard]] std::vector<std::string> cells_of_rank(int rank) const;
  /// Lines of the cells that all ranks were given, in the order of their bits.
  [[nodiscard]] std::vector<std::string> cells() const;
  Scratch scratch;
  Outcome outcome;

 private:
  [[nodiscard]] std::filesystem::path dump() const { return scratch.path("dump"); }
  [[nodiscard]] Outcome called(int ranks, const std::string& line, const std::string& more) const;
};

}  // namespace breccia::test
