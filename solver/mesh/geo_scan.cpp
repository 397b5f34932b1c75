#include "mesh/geo_scan.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <string_view>

namespace breccia {
namespace {

struct Token {
  enum class Kind { word, text, sign } kind;
  std::string value;
  int line;
};

bool starts_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool continues_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Words, texts and signs; comments and numbers dropped.
std::vector<Token> tokens_of(const std::string& source) {
  std::vector<Token> tokens;
  int line = 1;
  const std::size_t size = source.size();
  for (std::size_t i = 0; i < size;) {
    const char c = source[i];
    const std::string_view ahead(source.data() + i, std::min<std::size_t>(2, size - i));
    if (c == '\n') {
      ++line;
      ++i;
    } else if (ahead == "//") {
      i = std::min(source.find('\n', i), size);
    } else if (ahead == "/*") {
      const std::size_t end = std::min(source.find("*/", i + 2), size);
      line += static_cast<int>(std::count(source.begin() + static_cast<std::ptrdiff_t>(i),
                                          source.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
      i = std::min(end + 2, size);
    } else if (c == '"' || c == '\'') {
      const std::size_t end = std::min(source.find(c, i + 1), size);
      tokens.push_back({Token::Kind::text, source.substr(i + 1, end - i - 1), line});
      line += static_cast<int>(std::count(tokens.back().value.begin(), tokens.back().value.end(), '\n'));
      i = std::min(end + 1, size);
    } else if (starts_word(c)) {
      std::size_t end = i;
      while (end < size && continues_word(source[end])) ++end;
      tokens.push_back({Token::Kind::word, source.substr(i, end - i), line});
      i = end;
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
      while (i < size && (continues_word(source[i]) || source[i] == '.'))
        ++i;  // 1e-3: the sign and 3 come apart, harmless
    } else {
      if (std::isspace(static_cast<unsigned char>(c)) == 0) tokens.push_back({Token::Kind::sign, {c}, line});
      ++i;
    }
  }
  return tokens;
}

bool is(const Token& token, std::string_view sign_or_word) {
  return token.kind != Token::Kind::text && token.value == sign_or_word;
}
bool opens(const Token& token) { return is(token, "[") || is(token, "(") || is(token, "{"); }
bool closes(const Token& token) { return is(token, "]") || is(token, ")") || is(token, "}"); }

class Scanner {
 public:
  void read(const std::filesystem::path& file) {
    if (!visited_.insert(file.lexically_normal().string()).second) return;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return;  // a folder cannot be read, a pipe has no end
    std::ifstream in(file, std::ios::binary);
    if (!in) return;
    result.files.insert(file.lexically_normal());
    const std::vector<Token> tokens = tokens_of({std::istreambuf_iterator<char>(in), {}});
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      if (tokens[i].kind != Token::Kind::word) continue;
      if (is(tokens[i], "DefineConstant")) defined_names(tokens, i + 1);
      if (i + 2 < tokens.size() && is(tokens[i], "Exists") && opens(tokens[i + 1])) {
        result.constants.insert(tokens[i + 2].value);
      }
      if (i + 1 < tokens.size() && tokens[i + 1].kind == Token::Kind::text) {
        if (is(tokens[i], "Name")) result.onelab_names.insert(tokens[i + 1].value);
        if (is(tokens[i], "Include") || is(tokens[i], "Merge")) read(beside(file, tokens[i + 1].value));
      }
      refuse(file, tokens[i]);
    }
  }

  GeoScan result;

 private:
  static std::filesystem::path beside(const std::filesystem::path& file, const std::string& name) {
    const std::filesystem::path path(name);
    return path.is_absolute() ? path : file.parent_path() / path;
  }

  /// DefineConstant[ a = 1, b = {2, Name "B"}, c ]: the first word of each entry.
  void defined_names(const std::vector<Token>& tokens, std::size_t i) {
    int depth = 0;
    bool entry_starts = false;
    for (; i < tokens.size(); ++i) {
      const Token& token = tokens[i];
      if (opens(token)) {
        entry_starts = ++depth == 1;
      } else if (closes(token)) {
        if (--depth <= 0) return;
      } else if (depth == 1 && is(token, ",")) {
        entry_starts = true;
      } else {
        if (entry_starts && token.kind == Token::Kind::word) result.constants.insert(token.value);
        entry_starts = false;
      }
    }
  }

  void refuse(const std::filesystem::path& file, const Token& token) {
    constexpr std::array kRefused{"SystemCall", "NonBlockingSystemCall", "OnelabRun", "Exit", "Abort"};
    if (std::none_of(kRefused.begin(), kRefused.end(), [&](const char* word) { return token.value == word; })) return;
    result.problems.push_back({file.string(), token.line, token.value,
                               "a mesh script may not run programs or end the process", "geometry and mesh statements",
                               ""});
  }

  std::set<std::string> visited_;
};

}  // namespace

GeoScan scan_geo(const std::filesystem::path& file) {
  Scanner scanner;
  scanner.read(file);
  return std::move(scanner.result);
}

}  // namespace breccia
