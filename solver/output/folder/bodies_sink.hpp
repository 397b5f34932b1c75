#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/sink.hpp"

namespace breccia {

/// bodies.csv: names of the bodies that frames, contacts and gauges give by their numbers; a line a body, "body,name".
class BodiesSink final : public Sink {
 public:
  explicit BodiesSink(std::filesystem::path path) : path_(std::move(path)) {}
  /// Writes the file whole. Throws OutputError.
  void start(const RunStart& run) override;

 private:
  std::filesystem::path path_;
};

/// Its content: quotes around names with commas or quotes (RFC 4180).
[[nodiscard]] std::string bodies_csv(const std::vector<std::string>& names);

}  // namespace breccia
