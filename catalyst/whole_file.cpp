#include "catalyst/whole_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>

#include "catalyst/pipeline_error.hpp"

namespace breccia::insitu {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* what, int number) {
  throw PipelineError(path.string() + ": " + what + ": " + std::strerror(number));
}

/// A regular file of the folder of extracts, which may be another's: no link, pipe or device is opened.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags)
      : value_(::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666)) {
    if (value_ < 0) fail(path, "cannot be opened", errno);
    struct stat about {};
    if (::fstat(value_, &about) == 0 && S_ISREG(about.st_mode)) return;
    ::close(value_);
    throw PipelineError(path.string() + ": is no regular file");
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { ::close(value_); }
  [[nodiscard]] int value() const { return value_; }

 private:
  int value_;
};

void write_all(const std::filesystem::path& path, int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path, "cannot be written", errno);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace

std::int64_t replace_file(const std::filesystem::path& path, std::string_view content, Sync sync) {
  std::filesystem::path temporary = path;
  temporary.replace_filename("." + path.filename().string() + ".tmp");
  try {
    {
      ::unlink(temporary.c_str());  // of a run that was killed, or a link that somebody put there
      const Descriptor file(temporary, O_WRONLY | O_CREAT | O_EXCL);
      write_all(temporary, file.value(), content);
      if (sync == Sync::yes && ::fsync(file.value()) != 0) fail(temporary, "cannot be synced to the disk", errno);
    }
    if (::rename(temporary.c_str(), path.c_str()) != 0) fail(path, "cannot be replaced", errno);
  } catch (const PipelineError&) {
    ::unlink(temporary.c_str());
    throw;
  }
  return static_cast<std::int64_t>(content.size());
}

std::int64_t append_to_file(const std::filesystem::path& path, std::string_view content) {
  const Descriptor file(path, O_WRONLY | O_CREAT | O_APPEND);
  const off_t before = ::lseek(file.value(), 0, SEEK_END);
  try {
    write_all(path, file.value(), content);
  } catch (const PipelineError&) {
    static_cast<void>(!::ftruncate(file.value(), before));  // part of a line would spoil the next one
    throw;
  }
  return static_cast<std::int64_t>(content.size());
}

std::string file_content(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(std::filesystem::symlink_status(path, error))) return {};
  const Descriptor file(path, O_RDONLY);
  std::string content;
  std::array<char, 1 << 16> block{};
  for (;;) {
    const ssize_t size = ::read(file.value(), block.data(), block.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) fail(path, "cannot be read", errno);
    if (size == 0) return content;
    content.append(block.data(), static_cast<std::size_t>(size));
  }
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
