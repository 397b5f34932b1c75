#include "base/error.hpp"

#include <utility>

#include "base/printable.hpp"

namespace breccia {
namespace {

/// More lines than these hide the first ones, which are the ones to mend.
constexpr std::size_t kProblemsShown = 50;

}  // namespace

std::string Problem::text() const {
  std::string out;
  if (!file.empty()) {
    out += printable(file);
    if (line > 0) out.append(":").append(std::to_string(line));
    out += ": ";
  }
  if (!key.empty()) out.append(printable(key)).append(": ");
  out += printable(what);
  if (!allowed.empty()) out.append("; allowed: ").append(printable(allowed));
  if (!given.empty()) out.append("; given: ").append(printable(given));
  return out;
}

InputError::InputError(std::vector<Problem> problems) : problems_(std::move(problems)) {
  for (std::size_t i = 0; i < problems_.size() && i < kProblemsShown; ++i) {
    if (!text_.empty()) text_ += '\n';
    text_ += problems_[i].text();
  }
  if (problems_.size() > kProblemsShown)
    text_ += "\nand " + std::to_string(problems_.size() - kProblemsShown) + " more";
}

InputError::InputError(Problem problem) : InputError(std::vector<Problem>{std::move(problem)}) {}

void demand_failed(const char* condition, const char* file, int line, const std::string& detail) {
  throw InternalError(std::string(file) + ":" + std::to_string(line) + ": internal error, please report it: " +
                      condition + " does not hold" + (detail.empty() ? "" : " (" + detail + ")"));
}

Problem out_of_memory() {
  return {"",
          0,
          "",
          "out of memory; `breccia check` reports the memory that a case "
          "needs",
          "",
          ""};
}

}  // namespace breccia
