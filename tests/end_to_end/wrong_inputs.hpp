#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace breccia::test {

constexpr int kUsage = 1, kInput = 2;

/// One thing a user may get wrong: the case as changed, and what the program must say.
struct Wrong {
  std::string name;
  std::string from, to;                  ///< change of the small case; empty: none
  std::vector<std::string> message;      ///< fragments of stderr
  std::string arguments = "check CASE";  ///< CASE stands for the case file, DIR for a scratch folder
  int exit_code = kInput;
  std::string environment = {};
};

inline void PrintTo(const Wrong& wrong, std::ostream* stream) { *stream << wrong.name; }

/// At least 150 of them.
const std::vector<Wrong>& wrongs();

}  // namespace breccia::test
