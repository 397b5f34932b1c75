// libcatalyst's functions over nodes of our own; see standin.hpp.

#include "catalyst2/standin.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <set>
#include <stdexcept>
#include <thread>

#include "catalyst2/blueprint_check.hpp"

namespace breccia::test {
namespace {

struct Node {
  std::string name;
  bool is_list = false;
  std::vector<std::unique_ptr<Node>> children;
  bool is_leaf = false;
  StandinLeaf leaf{};

  Node* child(const std::string& wanted) {
    for (const auto& c : children) {
      if (c->name == wanted) return c.get();
    }
    return nullptr;
  }
  Node& add(const std::string& wanted) {
    children.push_back(std::make_unique<Node>());
    children.back()->name = wanted;
    return *children.back();
  }
  Node* existing(const std::string& path) {
    const std::size_t slash = path.find('/');
    Node* const next = child(path.substr(0, slash));
    return next == nullptr || slash == std::string::npos ? next : next->existing(path.substr(slash + 1));
  }
  Node& at(const std::string& path) {
    const std::size_t slash = path.find('/');
    const std::string first = path.substr(0, slash);
    Node* const known = child(first);
    Node& next = known != nullptr ? *known : add(first);
    return slash == std::string::npos ? next : next.at(path.substr(slash + 1));
  }
};

Standin state;
std::set<const Node*> roots;
const Node* last_executed = nullptr;

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool is_meant(const char* name) {
  const std::string wanted = variable("STANDIN_RANK"), mine = variable("OMPI_COMM_WORLD_RANK");
  return !variable(name).empty() && (wanted.empty() || wanted == (mine.empty() ? "0" : mine));
}

void flatten(const Node& node, const std::string& path, StandinTree& tree) {
  if (node.is_leaf) {
    tree.push_back(node.leaf);
    tree.back().path = path;
  }
  for (const auto& child : node.children) {
    std::string name = child->name;
    std::replace(name.begin(), name.end(), '/', '|');  // a name, such as "momentum x [kg m/s]", is no path
    flatten(*child, path.empty() ? name : path + "/" + name, tree);
  }
}

StandinTree tree_of(const void* root) {
  StandinTree tree;
  flatten(*static_cast<const Node*>(root), "", tree);
  return tree;
}

StandinLeaf& leaf_at(void* node, const char* path, StandinLeaf::Kind kind) {
  Node& found = *path == '\0' ? *static_cast<Node*>(node) : static_cast<Node*>(node)->at(path);
  found.is_leaf = true;
  found.leaf.kind = kind;
  return found.leaf;
}

void view(void* node, const char* path, StandinLeaf::Kind kind, const void* data, std::int64_t count,
          std::int64_t offset, std::int64_t stride, std::int64_t bytes) {
  StandinLeaf& leaf = leaf_at(node, path, kind);
  leaf.data = data;
  leaf.count = count;
  leaf.offset = offset;
  leaf.stride = stride;
  if (bytes != (kind == StandinLeaf::view_i32 ? 4 : 8))
    state.problems.emplace_back(std::string(path) + ": wrong bytes");
}

int told_status(const char* variable_name, int own) {
  if (!is_meant(variable_name)) return own;
  const std::string wish = variable(variable_name);
  if (wish == "throw") throw std::runtime_error("thrown on purpose");
  if (wish == "abort") std::abort();
  while (wish == "hang") std::this_thread::sleep_for(std::chrono::seconds(1));
  return std::atoi(wish.c_str());
}

void keep_problems(const StandinTree& tree) {
  for (const std::string& problem : blueprint_problems(tree)) {
    std::fprintf(stderr, "stand-in of libcatalyst: %s\n", problem.c_str());
    state.problems.push_back(problem);
  }
}

}  // namespace
}  // namespace breccia::test

using namespace breccia::test;
#define STANDIN_API extern "C" __attribute__((visibility("default")))

STANDIN_API Standin* standin() { return &state; }

STANDIN_API int catalyst_initialize(const void* root) {
  state.initialized = tree_of(root);
  return told_status("STANDIN_FAIL_INITIALIZE", state.initialize_status);
}

STANDIN_API int catalyst_execute(const void* root) {
  if (last_executed != nullptr && !roots.contains(last_executed))
    state.problems.emplace_back("the nodes of the execution before are gone");
  last_executed = static_cast<const Node*>(root);
  state.executed.push_back(tree_of(root));
  keep_problems(state.executed.back());
  if (const std::string folder = variable("STANDIN_DUMP"); !folder.empty())
    dump_cells(state.executed.back(), folder + "/rank_" + variable("OMPI_COMM_WORLD_RANK") + ".txt");
  if (state.on_execute) state.on_execute();
  if (state.execute_throws) throw std::runtime_error("thrown on purpose");
  const int status = told_status("STANDIN_FAIL_EXECUTE", state.execute_status);
  return status != 0 ? status : state.problems.empty() ? 0 : 100;
}

STANDIN_API int catalyst_finalize(const void*) {
  if (state.on_finalize) state.on_finalize();
  ++state.finalized;
  last_executed = nullptr;
  return 0;
}

STANDIN_API int catalyst_about(void* root) {
  const std::string told = variable("STANDIN_ABOUT");
  leaf_at(root, "catalyst/implementation", StandinLeaf::text).words = told.empty() ? state.about : told;
  return 0;
}

STANDIN_API void* catalyst_conduit_node_create() {
  auto* const node = new Node;
  roots.insert(node);
  state.live_nodes = static_cast<std::int64_t>(roots.size());
  return node;
}
STANDIN_API void catalyst_conduit_node_destroy(void* node) {
  if (roots.erase(static_cast<Node*>(node)) == 0) state.problems.emplace_back("destroys what is no root");
  state.live_nodes = static_cast<std::int64_t>(roots.size());
  delete static_cast<Node*>(node);
}
STANDIN_API void* catalyst_conduit_node_fetch(void* node, const char* path) {
  return &static_cast<Node*>(node)->at(path);
}
STANDIN_API void* catalyst_conduit_node_append(void* node) {
  Node& list = *static_cast<Node*>(node);
  list.is_list = true;
  return &list.add(std::to_string(list.children.size()));
}
STANDIN_API void* catalyst_conduit_node_add_child(void* node, const char* name) {
  return &static_cast<Node*>(node)->add(name);
}
STANDIN_API int catalyst_conduit_node_has_path(const void* node, const char* path) {
  return const_cast<Node*>(static_cast<const Node*>(node))->existing(path) != nullptr ? 1 : 0;
}
STANDIN_API char* catalyst_conduit_node_fetch_path_as_char8_str(void* node, const char* path) {
  return static_cast<Node*>(node)->at(path).leaf.words.data();
}
STANDIN_API void catalyst_conduit_node_set_char8_str(void* node, const char* text) {
  leaf_at(node, "", StandinLeaf::text).words = text;
}
STANDIN_API void catalyst_conduit_node_set_path_char8_str(void* node, const char* path, const char* text) {
  leaf_at(node, path, StandinLeaf::text).words = text;
}
STANDIN_API void catalyst_conduit_node_set_path_int64(void* node, const char* path, std::int64_t value) {
  leaf_at(node, path, StandinLeaf::integer).number = value;
}
STANDIN_API void catalyst_conduit_node_set_path_float64(void* node, const char* path, double value) {
  leaf_at(node, path, StandinLeaf::real).value = value;
}
STANDIN_API void catalyst_conduit_node_set_path_external_float64_ptr_detailed(void* node, const char* path,
                                                                              double* data, std::int64_t count,
                                                                              std::int64_t offset, std::int64_t stride,
                                                                              std::int64_t bytes, std::int64_t) {
  view(node, path, StandinLeaf::view_f64, data, count, offset, stride, bytes);
}
STANDIN_API void catalyst_conduit_node_set_path_external_int32_ptr_detailed(void* node, const char* path,
                                                                            std::int32_t* data, std::int64_t count,
                                                                            std::int64_t offset, std::int64_t stride,
                                                                            std::int64_t bytes, std::int64_t) {
  view(node, path, StandinLeaf::view_i32, data, count, offset, stride, bytes);
}
STANDIN_API void catalyst_conduit_node_set_path_external_int64_ptr_detailed(void* node, const char* path,
                                                                            std::int64_t* data, std::int64_t count,
                                                                            std::int64_t offset, std::int64_t stride,
                                                                            std::int64_t bytes, std::int64_t) {
  view(node, path, StandinLeaf::view_i64, data, count, offset, stride, bytes);
}
