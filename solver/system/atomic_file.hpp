#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "system/regular_file.hpp"

namespace breccia {

/// OutputError that reads "path: what: text of error_number" (an errno value; 0 leaves the last part out).
[[nodiscard]] OutputError output_error(const std::filesystem::path& path, const std::string& what,
                                       int error_number = 0);

/// With all folders above it; one that stands already is fine. Throws OutputError.
void create_folder(const std::filesystem::path& path);

/// Replaces the whole file `path` at once: a reader, and a run killed at any instant, sees the old content or the new
/// one, never a part. Writes `.name.tmp` in the same folder, syncs it to the disk, renames it and syncs the folder.
/// What stands under either name, a link above all, is replaced and not followed. @param depth  of `path`
/// @pre one writer a file at a time; `path` names a file in a folder that exists
/// @throws OutputError naming the file and the system's reason (disk full, no permission, missing folder, ...);
///         then the old file is unchanged and the temporary is removed.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> content,
                           Depth depth = Depth::file);
void write_file_atomically(const std::filesystem::path& path, std::string_view content, Depth depth = Depth::file);

struct FileContent {
  std::filesystem::path path;
  std::optional<std::span<const std::byte>> content;  ///< none: its temporary has been written already
};

/// Several files of one folder, which is synced once for all of them. All are on the disk before the first one is
/// renamed, and they are renamed in the order given: an index comes after what it lists.
/// @throws OutputError as above; no temporary stays, files renamed before the failure are complete.
void write_files_atomically(std::span<const FileContent> files, Depth depth = Depth::file);
/// The same in an open folder, of which the last name of each path is one.  @pre files is not empty
void write_files_atomically(const Descriptor& folder, std::span<const FileContent> files);

/// Waits until a file is on the disk; one that is not there has nothing to lose. Throws OutputError.
void sync_file(const std::filesystem::path& path);

/// Name of the temporary that write_file_atomically(path) uses; it survives only a kill.
[[nodiscard]] std::filesystem::path temporary_of(const std::filesystem::path& path);

/// A text file that grows by whole lines, each handed to the system before append_line returns: a run that is killed
/// loses no line that was appended.
class LineFile {
 public:
  /// Creates the file, a regular one in a run's folder, or empties it; or appends behind its first bytes and removes
  /// the others. Throws OutputError, also when the file is shorter than that.
  explicit LineFile(std::filesystem::path path, std::size_t keep = 0);
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;
  ~LineFile();

  /// Appends `line` and a line feed. Throws OutputError; a part of a line that did get written is cut off again.
  void append_line(std::string_view line);
  /// Waits until the lines are on the disk. Throws OutputError.
  void sync();
  [[nodiscard]] std::size_t size() const { return size_; }  ///< bytes of whole lines

 private:
  void reserve();

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::size_t size_ = 0;      ///< bytes of whole lines
  std::size_t reserved_ = 0;  ///< bytes up to which the disk has given room
};

}  // namespace breccia
