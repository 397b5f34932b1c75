#pragma once

namespace breccia {

/// What a confined process wrote to its report descriptor when it tried something that it may not.
inline constexpr char kForbiddenMark = 'F';

/// What becomes of a call that a confined process may not make.
enum class Refusal {
  error,        ///< it fails, as for want of permission
  ends_process  ///< the words of what was tried ("open a file for writing: FILE") go to `report` behind
                ///< kForbiddenMark, and the process leaves with code 1; where its signals are blocked (posix_spawn
                ///< does so) it ends by SIGSYS without words
};

/// Takes from this process, for good and with all its threads, the rights to run a program, to start a process, to
/// open a file for writing, to make, rename or remove one, to reach a network or another process (seccomp on Linux;
/// needs no privilege and no namespace, and root is bound by it as well). It keeps: memory, threads, reading of files,
/// the descriptors it has open.
///
/// Every other system call that is not needed for the above fails with EPERM. May be called again: the stricter
/// refusal holds.
///
/// @param report   descriptor open for writing, which gets kForbiddenMark and words when refusal is ends_process
/// @param refusal  what becomes of forbidden calls from now on
/// @return  false when the system cannot confine a process; then nothing has changed. Throws nothing.
[[nodiscard]] bool confine_this_process(int report, Refusal refusal);

}  // namespace breccia
