#pragma once

#include <ostream>
#include <string>
#include <utility>
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

/// At least 100 more: keys that stand for others, files of other programs, and what people type; each ends with one
/// message.
const std::vector<Wrong>& wrong_keys();
/// Files that these name beside the case: names and contents.
const std::vector<std::pair<std::string, std::string>>& wrong_data_files();

}  // namespace breccia::test
