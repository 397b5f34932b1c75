#pragma once

namespace breccia::insitu {

/// Functions of Xlib. The library is opened when the first of them is needed instead of linked: an adaptor that draws
/// nothing itself needs no X. It is the one that ParaView draws with, so its handlers are ParaView's too.
struct Xlib {
  using ErrorHandler = int (*)(void* display, void* event);
  using LossHandler = int (*)(void* display);
  using ExitHandler = void (*)(void* display, void* data);

  void* (*open_display)(const char* name);
  int (*close_display)(void* display);
  int (*query_extension)(void* display, const char* name, int* opcode, int* event, int* error);
  int (*connection_number)(void* display);
  ErrorHandler (*set_error_handler)(ErrorHandler handler);
  LossHandler (*set_io_error_handler)(LossHandler handler);
  void (*set_io_error_exit_handler)(void* display, ExitHandler handler, void* data);  ///< since libX11 1.7
};

/// Null when libX11 cannot be opened or lacks one of them. Once opened it stays: it does not survive being unloaded.
[[nodiscard]] const Xlib* xlib();

}  // namespace breccia::insitu
