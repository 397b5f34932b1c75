#include "catalyst2/opened_standin.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

#include "catalyst2/blueprint_check.hpp"

namespace breccia::test {

void name_catalyst(const std::string& library, const std::string& implementation) {
  setenv("BRECCIA_LIBCATALYST", library.c_str(), 1);
  setenv("CATALYST_IMPLEMENTATION_NAME", implementation.c_str(), 1);
}

Standin& fresh_standin(const std::string& implementation) {
  name_catalyst(BRECCIA_STANDIN, implementation);
  void* const library = dlopen(BRECCIA_STANDIN, RTLD_NOW | RTLD_GLOBAL);
  const auto entry = library == nullptr ? nullptr : reinterpret_cast<StandinEntry>(dlsym(library, "standin"));
  if (entry == nullptr) throw std::runtime_error(dlerror());
  const std::int64_t live = entry()->live_nodes;
  *entry() = {};
  entry()->live_nodes = live;
  entry()->about = implementation;
  return *entry();
}

void expect_view_of(const StandinTree& tree, const std::string& path, const BrecciaArray& array, std::int64_t cells) {
  const auto leaves = leaves_below(tree, path + "/values");
  ASSERT_EQ(static_cast<std::int32_t>(leaves.size()), array.components) << path;
  const std::int64_t bytes = array.type == BRECCIA_I32 ? 4 : 8;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const StandinLeaf& leaf = *leaves[i];
    EXPECT_EQ(leaf.kind, array.type == BRECCIA_F64   ? StandinLeaf::view_f64
                         : array.type == BRECCIA_I32 ? StandinLeaf::view_i32
                                                     : StandinLeaf::view_i64)
        << path;
    EXPECT_EQ(leaf.count, cells) << path;
    EXPECT_EQ(leaf.offset, bytes * static_cast<std::int64_t>(i)) << path;
    EXPECT_EQ(leaf.stride, bytes * array.components) << path;
    if (cells > 0) {
      EXPECT_EQ(leaf.data, array.values) << path << " was copied";
    }
  }
}

}  // namespace breccia::test
