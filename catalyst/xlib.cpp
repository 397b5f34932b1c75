#include "catalyst/xlib.hpp"

#include <dlfcn.h>

#include <optional>

namespace breccia::insitu {
namespace {

/// Whether the library has it.
template <class Function>
bool find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(::dlsym(library, name));
  return function != nullptr;
}

std::optional<Xlib> opened() {
  void* const library = ::dlopen("libX11.so.6", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return {};
  Xlib x{};
  const bool whole = find(library, "XOpenDisplay", x.open_display) && find(library, "XCloseDisplay", x.close_display) &&
                     find(library, "XQueryExtension", x.query_extension) &&
                     find(library, "XConnectionNumber", x.connection_number) &&
                     find(library, "XSetErrorHandler", x.set_error_handler) &&
                     find(library, "XSetIOErrorHandler", x.set_io_error_handler) &&
                     find(library, "XSetIOErrorExitHandler", x.set_io_error_exit_handler);
  return whole ? std::optional(x) : std::nullopt;
}

}  // namespace

const Xlib* xlib() {
  static const std::optional<Xlib> functions = opened();
  return functions ? &*functions : nullptr;
}

}  // namespace breccia::insitu
