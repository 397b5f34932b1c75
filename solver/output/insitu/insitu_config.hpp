#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "case/case.hpp"
#include "catalyst/insitu_abi.h"
#include "parallel/communicator.hpp"

namespace breccia {

/// Configuration of the adaptor for a run, with the strings that it points to.
class InSituConfig {
 public:
  /// @param folder  absolute
  InSituConfig(const case_::Case& input, const std::filesystem::path& folder, const Communicator& communicator);
  InSituConfig(const InSituConfig&) = delete;
  InSituConfig& operator=(const InSituConfig&) = delete;

  [[nodiscard]] const BrecciaConfig& get() const { return config_; }

 private:
  /// What a pipeline points to.
  struct Owned {
    std::vector<BrecciaParameter> parameters;
    std::array<double, 6> region{};
    std::vector<const char*> fields;
    std::vector<BrecciaProbe> probes;
  };
  void add(const case_::Pipeline& pipeline);
  void add_live(const case_::Live& live);
  /// The pipeline `made` with the cells and arrays that it gets.
  void select(BrecciaPipeline& made, Owned& owned, const std::optional<case_::Region>& region,
              const std::vector<std::string>& fields);

  case_::InSitu insitu_;
  std::string title_, folder_, run_, live_host_;
  std::vector<Owned> owned_;
  std::vector<BrecciaPipeline> pipelines_;
  BrecciaConfig config_{};
};

/// Runs one of the adaptor's functions that answer in words: call(text, size).
/// @return  the words
template <class Call>
std::string answer_of(Call&& call) {
  std::string text(std::size_t{1} << 17, '\0');
  call(text.data(), text.size());
  text.resize(text.find('\0'));
  return text;
}

/// Calls take(line, warns) for each line of an adaptor's notices, without the mark of a warning.
template <class Take>
void for_each_notice(const std::string& notices, Take&& take) {
  constexpr std::string_view kWarning = "warning: ";
  std::istringstream stream(notices);
  for (std::string line; std::getline(stream, line);) {
    const bool warns = line.starts_with(kWarning);
    take(warns ? line.substr(kWarning.size()) : line, warns);
  }
}

/// A problem of [insitu] for each line of a text.
[[nodiscard]] std::vector<Problem> insitu_problems(const std::filesystem::path& case_file, const std::string& lines);

}  // namespace breccia
