#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <map>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "mesh/file_input.hpp"
#include "mesh/set_mesh.hpp"
#include "mesh/set_readers.hpp"

namespace breccia {
namespace {

class MeditReader {
 public:
  explicit MeditReader(const std::filesystem::path& file) : file_(file.string()), in_(file) {}

  SetMesh read() {
    std::string word;
    if (!next(word) || word != "MeshVersionFormatted")
      refuse("is no mesh of Medit: it does not begin with MeshVersionFormatted", "text; binary ones end with .meshb");
    while (word != "End" && !word.empty()) word = section(word);
    for (auto& [name, set] : sets_) {
      set.name = name.first + std::to_string(name.second);
      made_.sets.push_back(std::move(set));
    }
    return std::move(made_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& allowed, const std::string& given = {}) {
    throw InputError(Problem{file_, in_.line(), "mesh.file", what, allowed, given});
  }

  /// The next word that is in no comment. Empty at the end.
  bool next(std::string& word) {
    std::string comment;
    while (in_.word(word) && word.starts_with('#')) in_.rest_of_line(comment);
    return !word.empty();
  }
  std::int64_t integer(const std::string& section) {
    std::string word;
    next(word);
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc{} || end != word.data() + word.size()) unexpected(section, word);
    return number;
  }
  double real(const std::string& section) {
    std::string word;
    next(word);
    double number = 0;
    const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, word.data() + word.size(), number);
    if (error == std::errc::invalid_argument || end != word.data() + word.size()) unexpected(section, word);
    return number;
  }
  [[noreturn]] void unexpected(const std::string& section, const std::string& word) {
    if (word.empty()) refuse("is cut off: it ends within " + section, "a whole file");
    if (std::isalpha(static_cast<unsigned char>(word[0])) != 0)
      refuse(section + " holds less than it states", "as many as are counted", word);
    refuse("a number is due here", section, word);
  }

  /// Reads one. Returns the keyword that follows.
  std::string section(const std::string& name) {
    if (name == "Vertices") {
      vertices();
    } else if (name == "Tetrahedra" || name == "TetrahedraP2") {
      elements(name, 4, name == "Tetrahedra" ? 4 : 10, "volume_");
    } else if (name == "Triangles" || name == "TrianglesP2") {
      elements(name, 3, name == "Triangles" ? 3 : 6, "surface_");
    } else if (name == "Edges" || name == "EdgesP2") {
      elements(name, 2, name == "Edges" ? 2 : 3, "curve_");
    } else {
      return skip(name);
    }
    std::string word;
    if (next(word) && std::isalpha(static_cast<unsigned char>(word[0])) == 0)
      refuse(name + " holds more than it states", "as many as are counted", word);
    return word;
  }

  std::string skip(const std::string& name) {
    std::string word;
    bool first = true;
    while (next(word) && std::isalpha(static_cast<unsigned char>(word[0])) == 0) {
      if (first && word != "0" && (name == "Hexahedra" || name == "Prisms" || name == "Pyramids"))
        refuse("solids of another shape than tetrahedra", "Tetrahedra, TetrahedraP2", word + " " + name);
      if (first && name == "Dimension" && word != "3") refuse("is not three-dimensional", "Dimension 3", word);
      first = false;
    }
    return word;
  }

  void vertices() {
    const std::int64_t count = integer("Vertices");
    for (std::int64_t i = 0; i < count; ++i) {
      Vec3 x;
      for (int a = 0; a < 3; ++a) x[a] = real("Vertices");
      real("Vertices");  // its reference
      made_.nodes.push_back(x);
    }
  }

  void elements(const std::string& name, int corners, int nodes, const char* group) {
    const std::int64_t count = integer(name);
    for (std::int64_t i = 0; i < count; ++i) {
      SetMesh::Element element{static_cast<std::int64_t>(made_.elements.size()) + 1, corners, {}};
      for (int n = 0; n < nodes; ++n) {
        const std::int64_t node = integer(name);
        if (node < 1 || node > static_cast<std::int64_t>(made_.nodes.size()))
          refuse(name + " has a vertex that the file does not have before it",
                 "1 to " + std::to_string(made_.nodes.size()), std::to_string(node));
        if (n < corners) element.nodes[static_cast<std::size_t>(n)] = static_cast<Index>(node - 1);
      }
      const std::int64_t reference = integer(name);
      sets_[{group, reference}].elements.push_back(static_cast<Index>(made_.elements.size()));
      made_.elements.push_back(element);
    }
    made_.higher_order = made_.higher_order || (nodes > corners && count > 0);
  }

  std::string file_;
  FileInput in_;
  SetMesh made_;
  std::map<std::pair<std::string, std::int64_t>, SetMesh::Set> sets_;
};

}  // namespace

RawMesh read_medit(const std::filesystem::path& file, double scale) {
  return raw_mesh(MeditReader(file).read(), file, scale);
}

}  // namespace breccia
