#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace breccia {

/// A line of an Abaqus input file: a keyword with its parameters, or data.
struct InpLine {
  std::string keyword;                            ///< in small letters without the star; empty: data
  std::map<std::string, std::string> parameters;  ///< names in small letters; values as they stand there
  std::vector<std::string> items;                 ///< of a line of data, without blanks around them
  bool continues = false;                         ///< the line of data ends with a comma
  std::string file;
  int line = 0;
};

/// The lines of an input file and of those that it includes, without comments and blank lines.
class InpLines {
 public:
  explicit InpLines(const std::filesystem::path& file) { open(file); }
  /// False at the end of the file.
  bool next(InpLine& line);
  /// Continues in another file, and returns at its end. False where it cannot be opened, or includes itself.
  bool open(const std::filesystem::path& file);

 private:
  struct Open {
    std::filesystem::path file;
    std::ifstream in;
    int line = 0;
  };
  bool raw_line(std::string& text);

  std::vector<std::unique_ptr<Open>> open_;
};

/// Small letters.
[[nodiscard]] std::string lower_case(std::string text);

}  // namespace breccia
