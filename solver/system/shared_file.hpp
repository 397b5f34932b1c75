#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace breccia {

/// A file that several ranks write, each to places of its own. All functions throw OutputError that names the file.
class SharedFile {
 public:
  /// @param path  in a folder of a run's folder (frames/, checkpoints/)
  /// @param file   named in errors
  /// @param flags  of open(2), beside O_WRONLY; O_CREAT: a new file replaces what is there
  SharedFile(const std::filesystem::path& path, const std::filesystem::path& file, int flags);
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;
  ~SharedFile();

  /// Takes the space on the disk where that can be done beforehand.
  void reserve(std::uint64_t size) const;
  void write_at(std::uint64_t offset, std::span<const std::byte> bytes) const;
  /// What has been written here is on the disk: other machines, and the rank that renames the file, can rely on it.
  void finish();

 private:
  [[noreturn]] void fail(int error) const;

  std::filesystem::path file_;
  int descriptor_;
};

}  // namespace breccia
