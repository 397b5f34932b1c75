#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace breccia {

/// How far a child may go.
struct ChildLimits {
  double seconds = 3600;    ///< wall time
  std::uint64_t bytes = 0;  ///< memory beyond what it starts with; 0: no limit
  bool confined = true;     ///< no right to run, write or connect (system/confinement.hpp)
  /// Confined, it reads these files and what is beneath these folders alone, where the kernel can see to that
  /// (system/file_access.hpp); empty: all files.
  std::vector<std::filesystem::path> readable{};
  int kept = -1;  ///< a descriptor of the parent's that it keeps, as kKeptDescriptor; -1: none
};

inline constexpr int kKeptDescriptor = 4;  ///< number of ChildLimits::kept in the child

/// How a child ended.
struct ChildEnd {
  enum class Kind {
    finished,       ///< `result` is what the work returned
    forbidden,      ///< it tried what a confined process may not; `text` names it
    out_of_time,    ///< ended after limits.seconds
    out_of_memory,  ///< ended by its limit, or by the system's
    crashed,        ///< by `signal`, or by leaving without a result; `text` is the last line it wrote to stderr
    interrupted,    ///< the parent was requested to end (system/interruption.hpp)
    not_confined,   ///< this system cannot confine a process: nothing was done
  };
  Kind kind = Kind::crashed;
  int signal = 0;
  std::string text;
  std::vector<std::byte> result;
};

/// Runs `work` in a forked copy of this process and returns its result. A crash, endless loop or memory bomb there ends
/// the child alone. It has its own stdin (empty), stdout and stderr (kept for `text`), no other descriptor of the
/// parent's than limits.kept, no core dump, and dies with the parent. Signals have their default meaning in it.
/// The work may read files (limits.readable), take memory up to the limit and start threads; with limits.confined it
/// may not write, run, connect or signal (confinement.hpp). Every failure ends as one of ChildEnd::Kind, never in this
/// process.
/// @param limits   seconds > 0, counted from the fork; bytes beyond what this process has at that moment
/// @param prepare  runs first, with refusals as errors: libraries that open files of their own when they start then
/// continue
/// @param work     runs in the child; what it changes there is lost. It returns any number of bytes. Neither may throw;
///                 std::bad_alloc alone is taken as the end of memory
/// Throws OutputError when the system refuses a process or a pipe; nothing is left behind then.
/// Blocks until the child has ended. Cost: a fork, and a copy of the result through a pipe.
[[nodiscard]] ChildEnd run_in_child(const ChildLimits& limits, const std::function<void()>& prepare,
                                    const std::function<std::vector<std::byte>()>& work);

/// Memory of this machine, or of the control group that this process is in where that is less; bytes.
[[nodiscard]] std::uint64_t memory_of_machine();

/// Memory that programs can still get on this machine without swapping, within that of the control group; bytes.
[[nodiscard]] std::uint64_t available_memory();

}  // namespace breccia
