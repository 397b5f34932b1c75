#include "catalyst2/blueprint_check.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <map>

namespace breccia::test {
namespace {

const std::map<std::string, std::int64_t> kCorners{{"point", 1}, {"tri", 3}, {"tet", 4}, {"hex", 8}};

bool is_view(const StandinLeaf* leaf) { return leaf != nullptr && leaf->kind >= StandinLeaf::view_f64; }

std::int64_t bytes_of(const StandinLeaf& view) { return view.kind == StandinLeaf::view_i32 ? 4 : 8; }

/// Problems of one mesh.
class MeshCheck {
 public:
  MeshCheck(const StandinTree& tree, std::string path, std::vector<std::string>& problems)
      : tree_(tree), path_(std::move(path)), problems_(problems) {}

  void run() {
    integer("state/domain_id");
    integer("state/cycle");
    if (const auto* time = at("state/time"); time == nullptr || time->kind != StandinLeaf::real) wrong("state/time");
    text("coordsets/coords/type", "explicit");
    text("topologies/mesh/type", "unstructured");
    text("topologies/mesh/coordset", "coords");
    std::int64_t points = -1;
    for (const char* axis : {"x", "y", "z"}) {
      const std::string name = std::string("coordsets/coords/values/") + axis;
      const StandinLeaf* const values = view(name);
      if (values == nullptr || values->kind != StandinLeaf::view_f64) return wrong(name);
      if (points >= 0 && values->count != points) wrong(name + " has another number of points");
      points = values->count;
    }
    elements(points);
    for (const std::string& field : names_below(tree_, path_ + "/fields")) check_field("fields/" + field);
  }

 private:
  [[nodiscard]] const StandinLeaf* at(const std::string& name) const { return leaf_of(tree_, path_ + "/" + name); }
  void wrong(const std::string& what) { problems_.push_back(path_ + "/" + what + " is wrong"); }
  void integer(const std::string& name) {
    if (const auto* leaf = at(name); leaf == nullptr || leaf->kind != StandinLeaf::integer) wrong(name);
  }
  void text(const std::string& name, const std::string& words) {
    if (const auto* leaf = at(name); leaf == nullptr || leaf->words != words) wrong(name);
  }
  const StandinLeaf* view(const std::string& name) {
    const StandinLeaf* const leaf = at(name);
    if (!is_view(leaf)) return nullptr;
    const std::int64_t bytes = bytes_of(*leaf);
    if (leaf->data == nullptr || leaf->count < 0 || leaf->stride % bytes != 0 || leaf->offset % bytes != 0 ||
        leaf->stride < leaf->offset + bytes)
      wrong(name + ": view");
    return leaf;
  }
  void elements(std::int64_t points) {
    const StandinLeaf* const shape = at("topologies/mesh/elements/shape");
    const StandinLeaf* const corners = view("topologies/mesh/elements/connectivity");
    if (shape == nullptr || !kCorners.contains(shape->words) || corners == nullptr ||
        corners->kind != StandinLeaf::view_i32 || corners->count % kCorners.at(shape->words) != 0)
      return wrong("topologies/mesh/elements");
    cells_ = corners->count / kCorners.at(shape->words);
    for (std::int64_t i = 0; i < corners->count; ++i) {
      if (static_cast<std::int64_t>(bits_of(*corners, i)) >= points) return wrong("a corner");
    }
  }
  void check_field(const std::string& name) {
    text(name + "/association", "element");
    text(name + "/topology", "mesh");
    const auto values = leaves_below(tree_, path_ + "/" + name + "/values");
    if (values.empty()) wrong(name + "/values");
    for (const StandinLeaf* leaf : values) {
      if (view(leaf->path.substr(path_.size() + 1)) == nullptr || leaf->count != cells_ ||
          leaf->kind != values.front()->kind || leaf->stride != values.front()->stride)
        wrong(leaf->path);
    }
  }

  const StandinTree& tree_;
  std::string path_;
  std::vector<std::string>& problems_;
  std::int64_t cells_ = 0;
};

}  // namespace

const StandinLeaf* leaf_of(const StandinTree& tree, const std::string& path) {
  const auto found = std::find_if(tree.begin(), tree.end(), [&](const StandinLeaf& leaf) { return leaf.path == path; });
  return found == tree.end() ? nullptr : &*found;
}

std::vector<const StandinLeaf*> leaves_below(const StandinTree& tree, const std::string& path) {
  std::vector<const StandinLeaf*> leaves;
  for (const StandinLeaf& leaf : tree) {
    if (leaf.path == path || leaf.path.starts_with(path + "/")) leaves.push_back(&leaf);
  }
  return leaves;
}

std::vector<std::string> names_below(const StandinTree& tree, const std::string& path) {
  std::vector<std::string> names;
  for (const StandinLeaf& leaf : tree) {
    if (!leaf.path.starts_with(path + "/")) continue;
    const std::string rest = leaf.path.substr(path.size() + 1), name = rest.substr(0, rest.find('/'));
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  return names;
}

std::uint64_t bits_of(const StandinLeaf& view, std::int64_t i) {
  const char* const place = static_cast<const char*>(view.data) + view.offset + i * view.stride;
  if (view.kind == StandinLeaf::view_i32) {
    std::int32_t value = 0;
    std::memcpy(&value, place, sizeof value);
    return static_cast<std::uint64_t>(std::int64_t{value});
  }
  std::uint64_t bits = 0;
  std::memcpy(&bits, place, sizeof bits);
  return bits;
}

std::vector<std::string> blueprint_problems(const StandinTree& tree) {
  std::vector<std::string> problems;
  for (const char* name : {"timestep", "cycle"}) {
    const StandinLeaf* const leaf = leaf_of(tree, std::string("catalyst/state/") + name);
    if (leaf == nullptr || leaf->kind != StandinLeaf::integer) problems.emplace_back(std::string("no state/") + name);
  }
  const StandinLeaf* const time = leaf_of(tree, "catalyst/state/time");
  if (time == nullptr || time->kind != StandinLeaf::real) problems.emplace_back("no state/time");
  for (const std::string& channel : names_below(tree, "catalyst/channels")) {
    const std::string path = "catalyst/channels/" + channel;
    const StandinLeaf* const type = leaf_of(tree, path + "/type");
    if (type == nullptr || type->words != "mesh") problems.push_back(path + " is no mesh");
    MeshCheck(tree, path + "/data", problems).run();
  }
  return problems;
}

void dump_cells(const StandinTree& tree, const std::string& file) {
  std::ofstream out(file, std::ios::app);
  out << std::hex;
  const std::string step = std::to_string(leaf_of(tree, "catalyst/state/timestep")->number);
  for (const std::string& channel : names_below(tree, "catalyst/channels")) {
    const std::string path = "catalyst/channels/" + channel + "/data";
    const StandinLeaf& corners = *leaf_of(tree, path + "/topologies/mesh/elements/connectivity");
    const std::int64_t per_cell = kCorners.at(leaf_of(tree, path + "/topologies/mesh/elements/shape")->words);
    for (std::int64_t cell = 0; cell < corners.count / per_cell; ++cell) {
      out << channel << ' ' << step;
      for (std::int64_t i = cell * per_cell; i < (cell + 1) * per_cell; ++i) {
        for (const StandinLeaf* axis : leaves_below(tree, path + "/coordsets/coords/values"))
          out << ' ' << bits_of(*axis, static_cast<std::int64_t>(bits_of(corners, i)));
      }
      for (const std::string& field : names_below(tree, path + "/fields")) {
        if (field == "rank" || field == "cost") continue;  // of the division among ranks, and of this run's speed
        for (const StandinLeaf* values : leaves_below(tree, path + "/fields/" + field + "/values"))
          out << ' ' << bits_of(*values, cell);
      }
      out << '\n';
    }
  }
}

}  // namespace breccia::test
