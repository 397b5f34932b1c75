#pragma once

#include <cstdint>
#include <string>

#include "catalyst/channel_names.hpp"
#include "catalyst/pipeline_error.hpp"
#include "catalyst/ranks.hpp"
#include "catalyst/whole_file.hpp"

namespace breccia::insitu {

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
