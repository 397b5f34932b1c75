#include "mesh/geo_scan.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <string_view>
#include <utility>

#include "base/geometry_file.hpp"
#include "base/trimmed.hpp"
#include "system/bounded_file.hpp"

namespace breccia {
namespace {

struct Token {
  enum class Kind { word, text, sign } kind;
  std::string value;
  int line;
  std::size_t begin;  ///< of it in the source
  std::size_t end;    ///< behind it
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
      tokens.push_back({Token::Kind::text, source.substr(i + 1, end - i - 1), line, i, std::min(end + 1, size)});
      line += static_cast<int>(std::count(tokens.back().value.begin(), tokens.back().value.end(), '\n'));
      i = std::min(end + 1, size);
    } else if (starts_word(c)) {
      std::size_t end = i;
      while (end < size && continues_word(source[end])) ++end;
      tokens.push_back({Token::Kind::word, source.substr(i, end - i), line, i, end});
      i = end;
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
      while (i < size && (continues_word(source[i]) || source[i] == '.'))
        ++i;  // 1e-3: the sign and 3 come apart, harmless
    } else {
      if (std::isspace(static_cast<unsigned char>(c)) == 0) tokens.push_back({Token::Kind::sign, {c}, line, i, i + 1});
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

/// The comment that stands at a place of the source or behind signs that end an entry, on the same line.
std::string comment_behind(std::string_view source, std::size_t at) {
  const std::string_view line = source.substr(at, source.find('\n', at) - at);
  const std::size_t begin = line.find_first_not_of(" \t,;])}");
  if (begin == std::string_view::npos) return {};
  const std::string_view comment = line.substr(begin);
  if (comment.starts_with("//")) return std::string(trimmed(comment.substr(2)));
  return comment.starts_with("/*") ? std::string(trimmed(comment.substr(2, comment.find("*/") - 2))) : std::string();
}

/// An expression without the comment that follows it.
std::string_view expression(std::string_view text) {
  return trimmed(text.substr(0, std::min(text.find("//"), text.find("/*"))));
}

class Scanner {
 public:
  explicit Scanner(bool keep_output) : keep_output_(keep_output) {}

  /// @param from  where it is included: file and line of the problem with it
  void read(const std::filesystem::path& file, const Problem& from) {
    if (!visited_.insert(file.lexically_normal().string()).second) return;
    if (visited_.size() > kMostFiles)
      return refuse_unread(file, "is one of more than " + std::to_string(kMostFiles) + " files", from);
    const BoundedFile content = read_bounded(file, bytes_left_);
    if (!content.problem.empty()) return refuse_unread(file, content.problem, from);
    bytes_left_ -= content.text.size();
    result.files.insert(file.lexically_normal());
    const std::string& source = content.text;
    const std::vector<Token> tokens = tokens_of(source);
    const bool outermost = visited_.size() == 1;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      if (tokens[i].kind != Token::Kind::word) continue;
      if (is(tokens[i], "DefineConstant")) defined_names(source, tokens, i + 1);
      if (i + 2 < tokens.size() && is(tokens[i], "Exists") && opens(tokens[i + 1]))
        add({tokens[i + 2].value, {}, {}, {}});
      if (i + 1 < tokens.size() && tokens[i + 1].kind == Token::Kind::text) {
        if (is(tokens[i], "Name")) add({{}, tokens[i + 1].value, {}, {}});
        if (is(tokens[i], "Include") || (is(tokens[i], "Merge") && may_be_script(tokens[i + 1].value)))
          read(beside(file, tokens[i + 1].value), {file.string(), tokens[i].line, tokens[i].value, {}, {}, {}});
      }
      if (outermost && leave_out(file, source, tokens, i)) break;
      refuse(file, tokens[i]);
    }
    if (outermost) result.without_output = rewritten(source);
  }

  GeoScan result;

 private:
  static std::filesystem::path beside(const std::filesystem::path& file, const std::string& name) {
    const std::filesystem::path path(name);
    return path.is_absolute() ? path : file.parent_path() / path;
  }

  /// What gmsh takes for another kind by its name it does not run.
  static bool may_be_script(const std::string& name) {
    const GeometryFile kind = geometry_file(name);
    return kind == GeometryFile::script || kind == GeometryFile::unknown;
  }

  /// A second one of the same name is ignored.
  void add(GeoParameter parameter) {
    const bool is_new = !parameter.name.empty() ? result.constants.insert(parameter.name).second
                                                : result.onelab_names.count(parameter.label) == 0;
    if (!parameter.label.empty()) result.onelab_names.insert(parameter.label);
    if (is_new) result.parameters.push_back(std::move(parameter));
  }

  /// DefineConstant[ a = 1, b = {2, Name "B"}, c ]: the first word of each entry names it.
  void defined_names(std::string_view source, const std::vector<Token>& tokens, std::size_t i) {
    int depth = 0;
    std::size_t entry = i;
    for (; i < tokens.size(); ++i) {
      const Token& token = tokens[i];
      const bool ends = depth == 1 && (is(token, ",") || closes(token));
      if (ends) add_entry(source, tokens, entry, i);
      if (opens(token)) {
        ++depth;
      } else if (closes(token) && --depth <= 0) {
        return;
      }
      if (ends || (depth == 1 && opens(token))) entry = i + 1;
    }
    if (depth > 0) add_entry(source, tokens, entry, tokens.size());  // never closed
  }

  /// @param begin, end  tokens of the entry and the one behind it
  void add_entry(std::string_view source, const std::vector<Token>& tokens, std::size_t begin, std::size_t end) {
    if (begin >= end || tokens[begin].kind != Token::Kind::word) return;
    GeoParameter found{tokens[begin].value, {}, {}, {}};
    const std::size_t behind = end < tokens.size() ? tokens[end].begin : source.size();
    std::size_t words_from = tokens[begin].begin + found.name.size();
    if (begin + 1 < end && is(tokens[begin + 1], "=")) {
      const std::size_t from = tokens[begin + 1].begin + 1;
      std::string_view value = expression(source.substr(from, behind - from));
      words_from = value.empty() ? from : static_cast<std::size_t>(value.data() - source.data()) + value.size();
      if (value.starts_with('{')) value = trimmed(value.substr(1, value.find_first_of(",}") - 1));  // {1, Name "h"}
      found.value = value;
    }
    found.words = comment_behind(source, words_from);
    for (std::size_t i = begin; i + 1 < end; ++i)
      if (is(tokens[i], "Name") && tokens[i + 1].kind == Token::Kind::text) found.label = tokens[i + 1].value;
    add(std::move(found));
  }

  /// A piece of the script and what takes its place.
  struct Change {
    std::size_t begin, end;
    std::string text;
  };

  /// Statements that end a script or write something are noted for `without_output`, and what depends on where the
  /// script is read. True where the script ends.
  bool leave_out(const std::filesystem::path& file, const std::string& source, const std::vector<Token>& tokens,
                 std::size_t& i) {
    const Token& token = tokens[i];
    for (const char* word : {"If", "For", "Macro", "Function"}) depth_ += is(token, word) ? 1 : 0;
    for (const char* word : {"EndIf", "EndFor", "Return"}) depth_ -= is(token, word) ? 1 : 0;
    const bool begins = i == 0 || is(tokens[i - 1], ";") || is(tokens[i - 1], "}") || is(tokens[i - 1], ")") ||
                        is(tokens[i - 1], "Else") || is(tokens[i - 1], "EndIf") || is(tokens[i - 1], "EndFor");
    const auto next_is = [&](const char* sign) { return i + 1 < tokens.size() && is(tokens[i + 1], sign); };
    if (begins && depth_ == 0 && (is(token, "Exit") || is(token, "Abort")) && next_is(";")) {
      changes_.push_back({token.begin, source.size(), {}});
      changes_what_is_run_ = true;
      return true;
    }
    const bool writes = is(token, "Save") || is(token, "Print") || is(token, "Draw") || is(token, "Sleep");
    if (begins && writes && !keep_output_ && !next_is("=") && !next_is(".") && !next_is("(")) {
      std::size_t end = i;
      while (end + 1 < tokens.size() && !is(tokens[end], ";")) ++end;
      std::string blank = source.substr(token.begin, tokens[end].end - token.begin);
      std::replace_if(
          blank.begin(), blank.end(), [](char c) { return c != '\n'; }, ' ');
      changes_.push_back({token.begin, tokens[end].end, blank});
      changes_what_is_run_ = true;
      i = end;
      return false;
    }
    name_in_full(file, tokens, i);
    return false;
  }

  /// Names of files that gmsh takes relative to the script, and its folder.
  void name_in_full(const std::filesystem::path& file, const std::vector<Token>& tokens, std::size_t i) {
    const Token& token = tokens[i];
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    if (is(token, "CurrentDirectory") || is(token, "CurrentDir"))
      changes_.push_back({token.begin, token.end, '"' + folder.string() + "/\""});
    const bool takes_file = is(token, "Include") || is(token, "Merge") || is(token, "ShapeFromFile");
    const std::size_t name = i + (is(token, "ShapeFromFile") ? 2 : 1);
    if (!takes_file || name >= tokens.size() || tokens[name].kind != Token::Kind::text) return;
    changes_.push_back(
        {tokens[name].begin, tokens[name].end, '"' + beside(folder / "x", tokens[name].value).string() + '"'});
  }

  [[nodiscard]] std::string rewritten(const std::string& source) const {
    if (!changes_what_is_run_) return {};
    std::string text;
    std::size_t from = 0;
    for (const Change& change : changes_) {
      text += source.substr(from, change.begin - from) + change.text;
      from = change.end;
    }
    return text + source.substr(from) + "\n";
  }

  /// A file that is not there is left for gmsh to name.
  void refuse_unread(const std::filesystem::path& file, const std::string& why, const Problem& from) {
    if (why == kDoesNotExist) return;
    Problem problem = from;
    problem.what = file.string() + " " + why;
    result.problems.push_back(std::move(problem));
  }

  void refuse(const std::filesystem::path& file, const Token& token) {
    constexpr std::array kRefused{"SystemCall", "NonBlockingSystemCall", "OnelabRun", "Exit", "Abort"};
    if (std::none_of(kRefused.begin(), kRefused.end(), [&](const char* word) { return token.value == word; })) return;
    result.problems.push_back({file.string(), token.line, token.value,
                               "a mesh script may not run programs or end the process", "geometry and mesh statements",
                               ""});
  }

  /// Files that a script is made of, and bytes of all of them together; far beyond those that programs write.
  static constexpr std::size_t kMostFiles = 1000;
  std::uint64_t bytes_left_ = 64'000'000;
  std::set<std::string> visited_;
  std::vector<Change> changes_;       ///< of the script itself, in their order
  bool changes_what_is_run_ = false;  ///< statements are left out
  bool keep_output_;
  int depth_ = 0;  ///< conditions, loops and macros that are open
};

}  // namespace

GeoScan scan_geo(const std::filesystem::path& file, bool keep_output) {
  Scanner scanner(keep_output);
  scanner.read(file, {file.string(), 0, {}, {}, {}, {}});
  return std::move(scanner.result);
}

}  // namespace breccia
