#include "output/folder/folder_tree.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>
#include <system_error>
#include <vector>

#include "system/atomic_file.hpp"
#include "system/write_all.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCannotCopy = "cannot copy this file of the run so far";
constexpr const char* kWrittenOnce = ".vtkhdf";  // ending of frames

struct Named {
  std::string name;
  EntryKind kind;
};

std::vector<Named> entries_in(const Descriptor& folder, const fs::path& path) {
  const int again = ::openat(folder.get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const std::unique_ptr<DIR, int (*)(DIR*)> stream(again < 0 ? nullptr : ::fdopendir(again), &::closedir);
  if (stream == nullptr) throw output_error(path, "cannot read this folder", errno);
  std::vector<Named> found;
  while (const dirent* entry = ::readdir(stream.get())) {
    const std::string name = entry->d_name;
    struct stat about {};
    if (name == "." || name == ".." || ::fstatat(folder.get(), name.c_str(), &about, AT_SYMLINK_NOFOLLOW) != 0)
      continue;
    found.push_back({name, S_ISREG(about.st_mode)   ? EntryKind::file
                           : S_ISDIR(about.st_mode) ? EntryKind::folder
                                                    : EntryKind::other});
  }
  return found;
}

Opened entered(const Descriptor& folder, const std::string& name, const fs::path& path) {
  Opened below = open_folder_at(folder, name);
  if (!below) throw output_error(path, "cannot read this folder: " + below.reason);
  return below;
}

/// A folder that is open, and its name in messages.
struct Place {
  const Descriptor& folder;
  fs::path path;
};

void copy_content(const Descriptor& from, const Descriptor& to, const fs::path& read_file,
                  const fs::path& written_file) {
  std::vector<std::byte> block(std::size_t{1} << 20);
  for (;;) {
    const ssize_t got = ::read(from.get(), block.data(), block.size());
    if (got == 0) return;
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw output_error(read_file, kCannotCopy, errno);
    const int error = write_all(to.get(), std::span(block).first(static_cast<std::size_t>(got)));
    if (error != 0) throw output_error(written_file, kCannotCopy, error);
  }
}

void copy_entry(const Place& from, const Place& to, const std::string& name) {
  const fs::path read_file = from.path / name, written_file = to.path / name;
  const bool written_once = fs::path(name).extension() == kWrittenOnce;
  if (written_once && ::linkat(from.folder.get(), name.c_str(), to.folder.get(), name.c_str(), 0) == 0) return;
  const Opened source = open_regular_at(from.folder, name, O_RDONLY);
  if (!source) throw output_error(read_file, std::string(kCannotCopy) + ": " + source.reason);
  ::unlinkat(to.folder.get(), name.c_str(), 0);
  const Opened target = open_regular_at(to.folder, name, O_WRONLY | O_CREAT | O_EXCL);
  if (!target) throw output_error(written_file, std::string(kCannotCopy) + ": " + target.reason);
  copy_content(source.descriptor, target.descriptor, read_file, written_file);
}

void copy_entries(const Place& from, const Place& to) {
  for (const Named& entry : entries_in(from.folder, from.path)) {
    if (entry.kind != EntryKind::folder) {
      copy_entry(from, to, entry.name);
      continue;
    }
    const fs::path read_folder = from.path / entry.name, written_folder = to.path / entry.name;
    if (::mkdirat(to.folder.get(), entry.name.c_str(), 0777) != 0 && errno != EEXIST)
      throw output_error(written_folder, "cannot copy this folder of the run so far", errno);
    const Opened source = entered(from.folder, entry.name, read_folder);
    const Opened target = entered(to.folder, entry.name, written_folder);
    copy_entries({source.descriptor, read_folder}, {target.descriptor, written_folder});
  }
}

}  // namespace

void walk_tree(const Descriptor& folder, const fs::path& path, const std::function<bool(const TreeEntry&)>& visit) {
  for (const Named& entry : entries_in(folder, path)) {
    const fs::path shown = path / entry.name;
    if (!visit({folder, entry.name, shown, entry.kind}) || entry.kind != EntryKind::folder) continue;
    walk_tree(entered(folder, entry.name, shown).descriptor, shown, visit);
  }
}

void remove_entry(const TreeEntry& entry) {
  const bool is_folder = entry.kind == EntryKind::folder;
  if (is_folder) {
    const Opened below = entered(entry.folder, entry.name, entry.path);
    for (const Named& inner : entries_in(below.descriptor, entry.path))
      remove_entry({below.descriptor, inner.name, entry.path / inner.name, inner.kind});
  }
  if (::unlinkat(entry.folder.get(), entry.name.c_str(), is_folder ? AT_REMOVEDIR : 0) != 0 && errno != ENOENT)
    throw output_error(entry.path, "cannot remove this result", errno);
}

std::string remove_file(const fs::path& path, Depth depth) {
  const Opened folder = open_folder_of(path, depth);
  if (!folder) return folder.error == ENOENT ? std::string() : "its folder: " + folder.reason;
  if (::unlinkat(folder.descriptor.get(), path.filename().c_str(), 0) == 0 || errno == ENOENT) return {};
  return std::generic_category().message(errno);
}

void copy_tree(const fs::path& from, const fs::path& to) {
  const Opened source = open_folder_of(from / "entry", Depth::subfolder);
  if (!source && source.error == ENOENT) return;
  if (!source) throw output_error(from, "cannot copy this folder of the run so far: " + source.reason);
  create_folder(to);
  const Opened target = open_folder_of(to / "entry", Depth::subfolder);
  if (!target) throw output_error(to, "cannot write into this folder: " + target.reason);
  copy_entries({source.descriptor, from}, {target.descriptor, to});
}

void copy_regular(const fs::path& from, const fs::path& to) {
  const Opened source = open_folder_of(from, Depth::file), target = open_folder_of(to, Depth::file);
  if (!source) throw output_error(from, std::string(kCannotCopy) + ": " + source.reason);
  if (!target) throw output_error(to, std::string(kCannotCopy) + ": " + target.reason);
  copy_entry({source.descriptor, from.parent_path()}, {target.descriptor, to.parent_path()}, from.filename().string());
}

}  // namespace breccia
