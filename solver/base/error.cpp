#include "base/error.hpp"

#include <utility>

namespace breccia {

std::string Problem::text() const {
  std::string out;
  if (!file.empty()) {
    out += file;
    if (line > 0) out.append(":").append(std::to_string(line));
    out += ": ";
  }
  if (!key.empty()) out.append(key).append(": ");
  out += what;
  if (!allowed.empty()) out.append("; allowed: ").append(allowed);
  if (!given.empty()) out.append("; given: ").append(given);
  return out;
}

InputError::InputError(std::vector<Problem> problems) : problems_(std::move(problems)) {
  for (const Problem& p : problems_) {
    if (!text_.empty()) text_ += '\n';
    text_ += p.text();
  }
}

InputError::InputError(Problem problem) : InputError(std::vector<Problem>{std::move(problem)}) {}

void demand_failed(const char* condition, const char* file, int line, const std::string& detail) {
  throw InternalError(std::string(file) + ":" + std::to_string(line) + ": internal error, please report it: " +
                      condition + " does not hold" + (detail.empty() ? "" : " (" + detail + ")"));
}

Problem out_of_memory() { return {"", 0, "", "out of memory; `breccia check` tells how much a case needs", "", ""}; }

}  // namespace breccia
