#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace breccia::insitu {

/// A node of Conduit, as libcatalyst's C functions know it.
struct ConduitNode;

/// The functions of libcatalyst 2 that are used: those of its own, and Conduit's under the names that it gives them.
/// They are part of its stable binary interface; all are taken by name when it is opened.
struct ConduitFunctions {
  using Run = int (*)(const ConduitNode*);
  using Ask = int (*)(ConduitNode*);
  Run initialize = nullptr, execute = nullptr, finalize = nullptr;
  Ask about = nullptr;

  ConduitNode* (*create)() = nullptr;
  void (*destroy)(ConduitNode*) = nullptr;
  ConduitNode* (*fetch)(ConduitNode*, const char* path) = nullptr;
  ConduitNode* (*append)(ConduitNode*) = nullptr;
  ConduitNode* (*add_child)(ConduitNode*, const char* name) = nullptr;
  int (*has_path)(const ConduitNode*, const char* path) = nullptr;
  char* (*path_as_text)(ConduitNode*, const char* path) = nullptr;
  void (*set_text)(ConduitNode*, const char*) = nullptr;
  void (*set_path_text)(ConduitNode*, const char* path, const char*) = nullptr;
  void (*set_path_int64)(ConduitNode*, const char* path, std::int64_t) = nullptr;
  void (*set_path_float64)(ConduitNode*, const char* path, double) = nullptr;
  template <class T>
  using View = void (*)(ConduitNode*, const char* path, T* data, std::int64_t count, std::int64_t offset,
                        std::int64_t stride, std::int64_t element_bytes, std::int64_t endianness);
  View<double> view_float64 = nullptr;
  View<std::int32_t> view_int32 = nullptr;
  View<std::int64_t> view_int64 = nullptr;

  /// Takes all of them from an opened library.
  /// @return  the names that it lacks
  [[nodiscard]] std::vector<std::string> take_from(void* library);
};

/// A tree of nodes that is destroyed with this object.
class ConduitTree {
 public:
  explicit ConduitTree(const ConduitFunctions& functions) : functions_(&functions), root_(functions.create()) {}
  ConduitTree(const ConduitTree&) = delete;
  ConduitTree& operator=(const ConduitTree&) = delete;
  ~ConduitTree() { functions_->destroy(root_); }
  [[nodiscard]] ConduitNode* root() const { return root_; }
  [[nodiscard]] const ConduitFunctions& functions() const { return *functions_; }

  void set(const char* path, const std::string& text) const { functions_->set_path_text(root_, path, text.c_str()); }
  void set(const char* path, std::int64_t value) const { functions_->set_path_int64(root_, path, value); }
  void set(const char* path, double value) const { functions_->set_path_float64(root_, path, value); }
  /// A list of texts.
  void set(const char* path, const std::vector<std::string>& texts) const {
    ConduitNode* const list = functions_->fetch(root_, path);
    for (const std::string& text : texts) functions_->set_text(functions_->append(list), text.c_str());
  }

 private:
  const ConduitFunctions* functions_;
  ConduitNode* root_;
};

}  // namespace breccia::insitu
