#include "catalyst/conduit.hpp"

#include <dlfcn.h>

namespace breccia::insitu {

std::vector<std::string> ConduitFunctions::take_from(void* library) {
  std::vector<std::string> lacking;
  const auto take = [&]<class Function>(Function& function, const char* name) {
    function = reinterpret_cast<Function>(::dlsym(library, name));
    if (function == nullptr) lacking.emplace_back(name);
  };
  take(initialize, "catalyst_initialize");
  take(execute, "catalyst_execute");
  take(finalize, "catalyst_finalize");
  take(about, "catalyst_about");
  take(create, "catalyst_conduit_node_create");
  take(destroy, "catalyst_conduit_node_destroy");
  take(fetch, "catalyst_conduit_node_fetch");
  take(append, "catalyst_conduit_node_append");
  take(add_child, "catalyst_conduit_node_add_child");
  take(has_path, "catalyst_conduit_node_has_path");
  take(path_as_text, "catalyst_conduit_node_fetch_path_as_char8_str");
  take(set_text, "catalyst_conduit_node_set_char8_str");
  take(set_path_text, "catalyst_conduit_node_set_path_char8_str");
  take(set_path_int64, "catalyst_conduit_node_set_path_int64");
  take(set_path_float64, "catalyst_conduit_node_set_path_float64");
  take(view_float64, "catalyst_conduit_node_set_path_external_float64_ptr_detailed");
  take(view_int32, "catalyst_conduit_node_set_path_external_int32_ptr_detailed");
  take(view_int64, "catalyst_conduit_node_set_path_external_int64_ptr_detailed");
  return lacking;
}

}  // namespace breccia::insitu
