#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "case/case.hpp"
#include "catalyst/insitu_abi.h"
#include "parallel/communicator.hpp"

namespace breccia {

/// What the adaptor is told of a run, with the strings that it points to.
class InSituConfig {
 public:
  /// @param folder  absolute
  InSituConfig(const case_::Case& input, const std::filesystem::path& folder, const Communicator& communicator);
  InSituConfig(const InSituConfig&) = delete;
  InSituConfig& operator=(const InSituConfig&) = delete;

  [[nodiscard]] const BrecciaConfig& get() const { return config_; }

 private:
  struct Parameters {
    std::vector<const char*> names;
    std::vector<double> values;
  };
  void add(const case_::Pipeline& pipeline);

  case_::InSitu insitu_;
  std::string title_, folder_, live_host_;
  std::vector<Parameters> parameters_;
  std::vector<BrecciaPipeline> pipelines_;
  BrecciaConfig config_{};
};

/// Runs one of the adaptor's functions that answer in words: call(text, size).
/// @return  the words
template <class Call>
std::string words_of(Call&& call) {
  std::string text(std::size_t{1} << 14, '\0');
  call(text.data(), text.size());
  text.resize(text.find('\0'));
  return text;
}

/// A problem of [insitu] for each line of a text.
[[nodiscard]] std::vector<Problem> insitu_problems(const std::filesystem::path& case_file, const std::string& lines);

}  // namespace breccia
