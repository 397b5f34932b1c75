#pragma once

#include <filesystem>
#include <span>

namespace breccia {

/// Takes from this process, for good and with all its threads, the right to open any file or folder but for reading,
/// and to read any that is neither in `readable`, nor beneath a folder in it, nor one of the system's libraries and
/// their data (/usr, /lib, /lib64). Links are followed: what counts is the place of what is opened. What is open stays
/// so, and files in memory can still be opened; names, sizes and dates of all files can be seen as before.
/// By Landlock, which kernels have from 5.13 on where it is not switched off; needs no privilege, binds root as well.
///
/// @param readable  folders and files; those that cannot be opened are left out
/// @return  false where the kernel has no Landlock: nothing has changed then. Throws nothing but bad_alloc.
[[nodiscard]] bool limit_file_access(std::span<const std::filesystem::path> readable);

}  // namespace breccia
