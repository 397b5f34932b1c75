#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>

#include "case/schema.hpp"

namespace breccia::case_::message_keys_test {
namespace {

/// Names of the user's choice in messages, which no table knows.
const std::set<std::string> examples{"material.glass.young"};

/// Dotted names in the texts of a line that begin with a section of the case but are no key of it.
std::set<std::string> unknown_keys(const std::string& line) {
  static const std::regex texts(R"re("(?:[^"\\]|\\.)*")re");
  static const std::regex paths(
      R"re((^|[^A-Za-z0-9_./<\]])([a-z_]+(\[\d*\])?(\.[a-z_0-9]+(\[\d*\])?)+)(?![A-Za-z0-9_(/]))re");
  std::set<std::string> unknown;
  for (std::sregex_iterator t(line.begin(), line.end(), texts), end; t != end; ++t) {
    const std::string text = t->str();
    for (std::sregex_iterator p(text.begin(), text.end(), paths); p != end; ++p) {
      const std::string plain = plain_path((*p)[2].str());
      const std::string section = plain.substr(0, plain.find('.'));
      bool of_case = false, known = false;
      for (const Key& key : schema()) {
        of_case = of_case || plain_path(key.path) == section;
        known = known || plain_path(key.path) == plain;
      }
      if (of_case && !known && !examples.contains(plain)) unknown.insert(plain);
    }
  }
  return unknown;
}

TEST(MessageKeys, AKeyThatNoTableHoldsIsFound) {
  EXPECT_EQ(unknown_keys(R"(refuse("mesh.repair_inverted = true, or stage[0].end");)"),
            std::set<std::string>{"mesh.repair_inverted"});
}

TEST(MessageKeys, EveryKeyThatAMessageOfTheSolverNamesExists) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(BRECCIA_SOLVER_SOURCES)) {
    const std::string kind = entry.path().extension().string();
    if (kind != ".cpp" && kind != ".hpp") continue;
    ++files;
    std::ifstream in(entry.path());
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
      if (line.starts_with('#')) continue;
      for (const std::string& key : unknown_keys(line))
        ADD_FAILURE() << entry.path().string() << ":" << number << ": no key of the case: " << key;
    }
  }
  EXPECT_GT(files, 100u);
}

}  // namespace
}  // namespace breccia::case_::message_keys_test
