#include "mesh/mesh_bytes.hpp"

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

namespace breccia {
namespace {

constexpr std::uint64_t kMeshFollows = 0x314853454d524221;     // "!BRMESH1"
constexpr std::uint64_t kProblemsFollow = 0x31424f5250524221;  // "!BRPROB1"

static_assert(std::is_standard_layout_v<Vec3> && sizeof(Vec3) == 3 * sizeof(double));

/// FNV-1a over eight bytes at a time: notices what a broken pipe or a dying process leaves.
std::uint64_t checksum(std::span<const std::byte> bytes) {
  std::uint64_t sum = 0xcbf29ce484222325;
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min<std::size_t>(8, bytes.size() - i));
    sum = (sum ^ word) * 0x100000001b3;
  }
  return sum;
}

class Writer {
 public:
  template <class T>
  void number(T value) {
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof value);
  }
  template <class T>
  void list(const std::vector<T>& values) {
    number<std::uint64_t>(values.size());
    const auto* first = reinterpret_cast<const std::byte*>(values.data());
    bytes.insert(bytes.end(), first, first + values.size() * sizeof(T));
  }
  void text(const std::string& value) { list(std::vector<char>(value.begin(), value.end())); }

  std::vector<std::byte> bytes;
};

[[noreturn]] void refuse(const std::string& what) {
  throw InputError(Problem{"", 0, "mesh", "the process that read the mesh gave no whole mesh: " + what, "", ""});
}

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <class T>
  T number() {
    T value{};
    take(&value, sizeof value);
    return value;
  }
  template <class T>
  std::vector<T> list() {
    const auto size = number<std::uint64_t>();
    if (size > rest_.size() / sizeof(T)) refuse("a list is longer than the received data");
    std::vector<T> values(static_cast<std::size_t>(size));
    take(static_cast<void*>(values.data()), values.size() * sizeof(T));
    return values;
  }
  std::string text() {
    const std::vector<char> letters = list<char>();
    return {letters.begin(), letters.end()};
  }
  /// Number of things of which each takes at least eight bytes.
  std::size_t count() {
    const auto size = number<std::uint64_t>();
    if (size > rest_.size() / 8) refuse("a list is longer than the received data");
    return static_cast<std::size_t>(size);
  }
  void end() const {
    if (!rest_.empty()) refuse("more came than a mesh");
  }

 private:
  void take(void* into, std::size_t size) {
    if (size > rest_.size()) refuse("it ends too early");
    if (size > 0) std::memcpy(into, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }
  std::span<const std::byte> rest_;
};

void write_texts(Writer& out, const std::vector<std::string>& texts) {
  out.number<std::uint64_t>(texts.size());
  for (const std::string& t : texts) out.text(t);
}

std::vector<std::string> read_texts(Reader& in) {
  std::vector<std::string> texts(in.count());
  for (std::string& t : texts) t = in.text();
  return texts;
}

void write(Writer& out, const RawMesh& raw) {
  const Mesh& mesh = raw.mesh;
  out.number(kMeshFollows);
  out.text(mesh.source);
  out.list(mesh.nodes);
  out.list(mesh.elements);
  out.list(mesh.element_group);
  out.list(mesh.element_body);
  out.list(mesh.element_source_id);
  out.list(mesh.surface_faces);
  out.list(mesh.group_nodes);
  out.list(mesh.set_elements);
  write_texts(out, mesh.volume_groups);
  write_texts(out, mesh.surface_groups);
  write_texts(out, mesh.node_groups);
  write_texts(out, mesh.element_sets);
  out.number(mesh.num_bodies);
  out.number(raw.ungrouped_elements);
  write_texts(out, raw.notes);
}

/// True for 0 <= index < size.
bool within(Index index, std::size_t size) { return index >= 0 && static_cast<std::size_t>(index) < size; }

void check(const RawMesh& raw) {
  const Mesh& mesh = raw.mesh;
  const std::size_t elements = mesh.elements.size(), nodes = mesh.nodes.size();
  if (mesh.element_group.size() != elements || mesh.element_body.size() != elements ||
      mesh.element_source_id.size() != elements)
    refuse("lists of elements differ in length");
  if (mesh.num_bodies < 0 || static_cast<std::size_t>(mesh.num_bodies) > elements || raw.ungrouped_elements < 0)
    refuse("a count is out of range");
  for (std::size_t e = 0; e < elements; ++e) {
    for (const Index n : mesh.elements[e]) {
      if (!within(n, nodes)) refuse("an element names a node that is not there");
    }
    if (!within(mesh.element_group[e], mesh.volume_groups.size()) ||
        !within(mesh.element_body[e], static_cast<std::size_t>(mesh.num_bodies)))
      refuse("an element is of a group or body that is not there");
  }
  for (const Mesh::SurfaceFace& face : mesh.surface_faces) {
    for (const Index n : face.nodes) {
      if (!within(n, nodes)) refuse("a triangle names a node that is not there");
    }
    if (!within(face.group, mesh.surface_groups.size())) refuse("a triangle is of a group that is not there");
  }
  for (const Mesh::GroupNode& one : mesh.group_nodes) {
    if (!within(one.node, nodes) || !within(one.group, mesh.node_groups.size()))
      refuse("a curve or point names a node or a group that is not there");
  }
  for (const Mesh::SetElement& one : mesh.set_elements) {
    if (!within(one.element, elements) || !within(one.group, mesh.element_sets.size()))
      refuse("a set names an element or a group that is not there");
  }
}

RawMesh read_mesh(Reader& in) {
  RawMesh raw;
  Mesh& mesh = raw.mesh;
  mesh.source = in.text();
  mesh.nodes = in.list<Vec3>();
  mesh.elements = in.list<std::array<Index, 4>>();
  mesh.element_group = in.list<Index>();
  mesh.element_body = in.list<Index>();
  mesh.element_source_id = in.list<std::int64_t>();
  mesh.surface_faces = in.list<Mesh::SurfaceFace>();
  mesh.group_nodes = in.list<Mesh::GroupNode>();
  mesh.set_elements = in.list<Mesh::SetElement>();
  mesh.volume_groups = read_texts(in);
  mesh.surface_groups = read_texts(in);
  mesh.node_groups = read_texts(in);
  mesh.element_sets = read_texts(in);
  mesh.num_bodies = in.number<Index>();
  raw.ungrouped_elements = in.number<Index>();
  raw.notes = read_texts(in);
  in.end();
  check(raw);
  return raw;
}

std::vector<Problem> read_problems(Reader& in) {
  std::vector<Problem> problems(in.count());
  for (Problem& p : problems) {
    p.file = in.text();
    p.line = in.number<int>();
    for (std::string* part : {&p.key, &p.what, &p.allowed, &p.given}) *part = in.text();
  }
  in.end();
  if (problems.empty()) refuse("an empty list of problems");
  return problems;
}

}  // namespace

std::vector<std::byte> bytes_of(const MeshOrProblems& read) {
  Writer out;
  if (const auto* raw = std::get_if<RawMesh>(&read)) {
    write(out, *raw);
  } else {
    const auto& problems = std::get<std::vector<Problem>>(read);
    out.number(kProblemsFollow);
    out.number<std::uint64_t>(problems.size());
    for (const Problem& p : problems) {
      out.text(p.file);
      out.number(p.line);
      for (const std::string* part : {&p.key, &p.what, &p.allowed, &p.given}) out.text(*part);
    }
  }
  out.number(checksum(out.bytes));
  return std::move(out.bytes);
}

MeshOrProblems mesh_of(std::span<const std::byte> bytes) {
  std::uint64_t sum = 0;
  if (bytes.size() < 2 * sizeof sum) refuse("it ends too early");
  const auto content = bytes.first(bytes.size() - sizeof sum);
  std::memcpy(&sum, bytes.data() + content.size(), sizeof sum);
  if (sum != checksum(content)) refuse("its checksum differs");
  Reader in(content);
  const auto kind = in.number<std::uint64_t>();
  if (kind == kMeshFollows) return read_mesh(in);
  if (kind == kProblemsFollow) return read_problems(in);
  refuse("it begins with neither a mesh nor a problem");
}

}  // namespace breccia
