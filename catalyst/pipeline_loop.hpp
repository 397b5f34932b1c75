#pragma once

#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>

#include "catalyst/channel_names.hpp"
#include "catalyst/pipeline_error.hpp"
#include "catalyst/ranks.hpp"
#include "catalyst/whole_file.hpp"

namespace breccia::insitu {

/// In front of a line of notices that warns.
constexpr std::string_view kWarning = "warning: ";

/// What call() fails of on any rank, the same on all; empty: nothing. Collective. Throws Abandoned with the name.
template <class Call>
[[nodiscard]] std::string failure_of(const Ranks& ranks, const std::string& name, Call&& call) {
  std::string error;
  try {
    try {
      call();
    } catch (const Abandoned&) {
      throw;
    } catch (const std::exception& failure) {
      error = failure.what();
    } catch (...) {
      error = "has thrown an object that is no exception";
    }
    return ranks.agree(error);
  } catch (const Abandoned& wait) {
    throw Abandoned(name + ": " + wait.what());
  }
}

/// This rank's notices to those of all: the first rank's, and those of the lowest one that has others. Collective.
[[nodiscard]] inline std::string agreed_notices(const Ranks& ranks, const std::string& mine) {
  const std::string none, first = ranks.agree(ranks.is_root() ? mine : none);
  return first + ranks.agree(ranks.is_root() ? none : mine);
}

/// Lines of a pipeline's notices as they leave the adaptor, with its name.
[[nodiscard]] inline std::string with_name(const std::string& name, const std::string& notices) {
  std::istringstream lines(notices);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    const bool warns = line.starts_with(kWarning);
    text += (warns ? std::string(kWarning) : "") + "pipeline " + name + ": " +
            one_line(line.substr(warns ? kWarning.size() : 0)) + '\n';
  }
  return text;
}

/// Calls work(i) for each pipeline of a mask, one after the other; name_of(i) is its name. Those that fail on any
/// rank are returned and add a line "name: what" to `text`. Collective. Throws Abandoned.
template <class Names, class Work>
std::uint32_t execute_each(const Ranks& ranks, std::uint32_t pipelines, int num_pipelines, const Names& name_of,
                           std::string& text, Work&& work) {
  std::uint32_t failed = 0;
  for (int i = 0; i < num_pipelines; ++i) {
    if ((pipelines & bit(i)) == 0) continue;
    const std::string name = name_of(i), error = failure_of(ranks, name, [&] { work(i); });
    if (error.empty()) continue;
    failed |= bit(i);
    text += name + ": " + one_line(error) + '\n';
  }
  return failed;
}

}  // namespace breccia::insitu
