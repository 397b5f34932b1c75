#include "commands/data_report.hpp"

#include <fmt/core.h>

#include "advice/rule_functions.hpp"
#include "base/quantity_text.hpp"

namespace breccia {

std::string data_report(const case_::Case& input) {
  std::string text;
  for (const case_::DataFiles::One& one : data_files(input)) {
    text += fmt::format("{}: {}, {} points from {} to {}, from {} to {}\n", one.key, one.file.filename().string(),
                        one.num_points, quantity_text(one.first.time, "s"), quantity_text(one.last.time, "s"),
                        quantity_text(one.least, one.unit), quantity_text(one.largest, one.unit));
  }
  return text;
}

}  // namespace breccia
