#include "catalyst/whole_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

#include "catalyst/pipeline_error.hpp"
#include "run_folder/content.hpp"
#include "system/open_regular.hpp"
#include "system/write_all.hpp"

namespace breccia::insitu {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* what, int number) {
  throw PipelineError(path.string() + ": " + what + ": " + std::strerror(number));
}

/// A regular file of the folder of extracts, which may be another's: no link, pipe or device is opened.
Descriptor opened(const std::filesystem::path& path, int flags) {
  Opened file = open_regular(path, flags, Depth::file);
  if (!file) throw PipelineError(path.string() + ": cannot be opened: " + file.reason);
  return std::move(file.descriptor);
}

void write_whole(const std::filesystem::path& path, const Descriptor& file, std::string_view content) {
  if (const int error = write_all(file.get(), content); error != 0) fail(path, "cannot be written", error);
}

}  // namespace

std::int64_t replace_file(const std::filesystem::path& path, std::string_view content, Sync sync) {
  std::filesystem::path temporary = path;
  temporary.replace_filename("." + path.filename().string() + ".tmp");
  try {
    {
      ::unlink(temporary.c_str());  // of a run that was killed, or a link that somebody put there
      const Descriptor file = opened(temporary, O_WRONLY | O_CREAT | O_EXCL);
      write_whole(temporary, file, content);
      if (sync == Sync::yes && ::fsync(file.get()) != 0) fail(temporary, "cannot be synced to the disk", errno);
    }
    if (::rename(temporary.c_str(), path.c_str()) != 0) fail(path, "cannot be replaced", errno);
  } catch (const PipelineError&) {
    ::unlink(temporary.c_str());
    throw;
  }
  return static_cast<std::int64_t>(content.size());
}

std::int64_t append_to_file(const std::filesystem::path& path, std::string_view content) {
  const Descriptor file = opened(path, O_WRONLY | O_CREAT | O_APPEND);
  const off_t before = ::lseek(file.get(), 0, SEEK_END);
  try {
    write_whole(path, file, content);
  } catch (const PipelineError&) {
    static_cast<void>(!::ftruncate(file.get(), before));  // part of a line would spoil the next one
    throw;
  }
  return static_cast<std::int64_t>(content.size());
}

std::string file_content(const std::filesystem::path& path) {
  run_folder::Content content = run_folder::read_content(path);
  if (!content.problem.empty()) throw PipelineError(path.string() + ": cannot be read: " + content.problem);
  return std::move(content.text);
}

void make_folder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  // An existing file of that name is not always an error to create_directories.
  if (!error && !std::filesystem::is_directory(path)) error = std::make_error_code(std::errc::not_a_directory);
  if (error) throw PipelineError(path.string() + ": the folder cannot be made: " + error.message());
}

std::string exact(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool blank = static_cast<unsigned char>(c) <= ' ';
    if (!blank) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

}  // namespace breccia::insitu
