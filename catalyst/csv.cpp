#include "catalyst/csv.hpp"

#include <sstream>

namespace breccia::insitu {

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\n") == std::string::npos) return field;
  std::string text = "\"";
  for (const char c : field) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

std::string rows_before(const std::string& content, const std::string& header, std::int64_t step) {
  std::string kept;
  std::istringstream stream(content);
  std::string line;
  if (!std::getline(stream, line) || line != header) return kept;
  while (std::getline(stream, line) && !stream.eof()) {
    std::int64_t of_line = 0;
    if (std::istringstream(line) >> of_line && of_line < step) kept += line + '\n';
  }
  return kept;
}

}  // namespace breccia::insitu
