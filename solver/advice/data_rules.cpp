#include "advice/rule_functions.hpp"

#include <fmt/core.h>
#include <charconv>
#include <set>
#include <utility>
#include <vector>

#include "base/quantity_text.hpp"

namespace breccia {
namespace {

/// The stage of "stage[1].gravity[2]". @pre functions of time stand in stages alone
std::size_t stage_of(const std::string& key) {
  std::size_t stage = 0;
  const std::size_t open = key.find('[') + 1;
  std::from_chars(key.data() + open, key.data() + key.size(), stage);
  return stage;
}

}  // namespace

std::vector<case_::DataFiles::One> data_files(const case_::Case& input) {
  std::vector<case_::DataFiles::One> files;
  std::set<std::pair<std::string, std::string>> known;
  for (const case_::DataFiles::One& one : input.data.files) {
    if (known.emplace(one.key, one.file.string()).second) files.push_back(one);
  }
  return files;
}

Sentences data_file_times(const case_::Case& input) {
  constexpr double kRoundOff = 1e-6, kNextToNothing = 0.01;  // of a stage; of the times of a file
  Sentences advice;
  for (const case_::DataFiles::One& one : data_files(input)) {
    const std::size_t stage = stage_of(one.key);
    const double start = stage > 0 ? input.stages[stage - 1].end : 0, end = input.stages[stage].end;
    const std::string name = one.file.filename().string();
    if (one.num_points > 1 && one.last.time < end - kRoundOff * (end - start)) {
      advice.push_back(fmt::format("{} ends at {}: from there to the end of the stage at {}, {} stays at {}.", name,
                                   quantity_text(one.last.time, "s"), quantity_text(end, "s"), one.key,
                                   quantity_text(one.last.value, one.unit)));
    } else if (end - start < kNextToNothing * (one.last.time - one.first.time)) {
      advice.push_back(fmt::format(
          "{} goes from {} to {}, and the stage of {} lasts {}: if the times of the file are in another unit, name it "
          "in csv.time_unit.",
          name, quantity_text(one.first.time, "s"), quantity_text(one.last.time, "s"), one.key,
          quantity_text(end - start, "s")));
    }
  }
  return advice;
}

}  // namespace breccia
