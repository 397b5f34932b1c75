#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "system/regular_file.hpp"

namespace breccia {

// Work on a folder of a run and all below it, by open folders: no link is followed, so nothing outside is reached.

enum class EntryKind { file, folder, other };  ///< other: a link, pipe, device or socket

struct TreeEntry {
  const Descriptor& folder;    ///< that it is in
  const std::string& name;     ///< there
  std::filesystem::path path;  ///< for messages
  EntryKind kind;
};

/// Entries of an open folder. @param visit  returns whether the entry, a folder, is entered after the call
/// @param path  of the folder, for messages. Throws OutputError: a folder cannot be read.
void walk_tree(const Descriptor& folder, const std::filesystem::path& path,
               const std::function<bool(const TreeEntry&)>& visit);

/// Removes an entry, a folder with all in it. Throws OutputError.
void remove_entry(const TreeEntry& entry);

/// Removes a file of a run's folder, of any kind except a folder.
/// @return  why that cannot be done; empty: it is not there any more
[[nodiscard]] std::string remove_file(const std::filesystem::path& path, Depth depth);

/// Copies a folder into another run's folder. Frames, which are written once, become hard links where that can be done.
/// No folder: nothing is done. @pre `to` does not exist or is an empty folder
/// Throws OutputError that names what cannot be copied: links, pipes and devices among them.
void copy_tree(const std::filesystem::path& from, const std::filesystem::path& to);

/// Copies a file of a run's folder likewise. @pre both paths end in the same name
void copy_regular(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace breccia
