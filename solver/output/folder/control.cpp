#include "output/folder/control.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <system_error>
#include <thread>

#include "base/trimmed.hpp"
#include "case/units.hpp"
#include "output/folder/folder_check.hpp"
#include "output/folder/run_folder.hpp"
#include "output/folder/run_lock.hpp"
#include "run_folder/growing_lines.hpp"
#include "run_folder/status.hpp"
#include "system/atomic_file.hpp"
#include "system/regular_file.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestRequest = 1 << 16;  // bytes; what is longer is cut
constexpr std::size_t kLongestLine = 200;         // bytes; longer lines are no commands, and reported truncated
constexpr std::size_t kMostLines = 100;           // of one request, each of which is answered; the rest is not
constexpr auto kPollInterval = std::chrono::milliseconds(20);  // between two polls for an answer

/// Takes " id=WORD" off the end.
std::string take_id(std::string& text) {
  const std::size_t start = text.rfind(" id=");
  if (start == std::string::npos) return {};
  const std::string id(trimmed(text.substr(start + 4)));
  text = std::string(trimmed(text.substr(0, start)));
  return id;
}

void set_interval(Command& command, const std::string& time) {
  if (time.empty()) {
    command.complaint = "frame_interval needs a simulated time; allowed: such as \"frame_interval 2 us\"; given: none";
    return;
  }
  try {
    command.value = case_::to_si(time, "s");
    if (std::isfinite(command.value) && command.value >= 0) {
      command.kind = Command::Kind::frame_interval;
      return;
    }
    command.complaint =
        "frame_interval is out of range; allowed: a simulated time >= 0, such as \"2 us\"; given: " + time;
  } catch (const case_::UnitError& error) {
    command.complaint =
        "frame_interval " + std::string(error.what()) +
        "; allowed: a simulated time with a decimal point and its unit, such as \"2.5 us\"; given: " + time;
  }
}

std::vector<std::string> lines_of(std::istream& stream) {
  std::vector<std::string> lines;
  for (std::string line; lines.size() < kMostLines && std::getline(stream, line);) {
    line = std::string(trimmed(line));
    if (line.size() > kLongestLine) line.replace(kLongestLine, std::string::npos, "...");
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

/// Of an ordinary file; nothing of a pipe, a folder or a link, which might never end or be another user's.
std::string content_of(const fs::path& path) {
  const Opened file = open_regular(path, O_RDONLY, Depth::file);
  if (!file) return {};
  std::string text(kLongestRequest, '\0');
  const ssize_t got = ::read(file.descriptor.get(), text.data(), text.size());
  text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return text;
}

/// Places a request for the run, once earlier ones have been removed: a link never replaces.
/// @return  false when the time is over
bool put_request(const fs::path& control, const std::string& line, const std::string& id,
                 const std::function<bool()>& in_time) {
  const fs::path own = control.parent_path() / (".control." + id);
  write_file_atomically(own, line);
  std::error_code error, ignored;
  bool put = false;
  while (!put && in_time()) {
    fs::create_hard_link(own, control, error);
    put = !error;
    if (error == std::errc::operation_not_permitted || error == std::errc::operation_not_supported) {
      fs::rename(own, control, error);  // a file system without links
      put = !error;
    }
    if (!put) std::this_thread::sleep_for(kPollInterval);
  }
  fs::remove(own, ignored);
  return put;
}

OutputError no_answer(const fs::path& folder, const std::string& what, const std::string& allowed) {
  Problem problem;
  problem.file = folder.string();
  problem.what = what;
  problem.allowed = allowed;
  return OutputError(problem);
}

bool is_over(const run_folder::StatusLine& line) { return line.status && run_folder::is_end(line.status->state); }

}  // namespace

Command parse_command(std::string_view line) {
  Command command;
  command.text = trimmed(line);
  command.id = take_id(command.text);
  std::istringstream words(command.text);
  std::string word, rest;
  words >> word;
  std::getline(words, rest);
  rest = std::string(trimmed(rest));
  using Kind = Command::Kind;
  if (word == "frame_interval") {
    set_interval(command, rest);
    return command;
  }
  for (const auto& [name, kind] : {std::pair{"pause", Kind::pause},
                                   {"resume", Kind::resume},
                                   {"stop", Kind::stop},
                                   {"extract", Kind::extract},
                                   {"frame", Kind::frame},
                                   {"checkpoint", Kind::checkpoint}}) {
    if (word == name && rest.empty()) command.kind = kind;
  }
  if (command.kind == Kind::refused)
    command.complaint = "no such command; allowed: " + std::string(kCommandWords) + "; given: " + command.text;
  return command;
}

std::vector<std::string> ControlFile::take() {
  if (!pace_.due()) return {};
  pace_.done();
  fs::path taken = temporary_of(path_);
  if (num_left_ > 0) taken += std::to_string(num_left_);
  std::error_code error;
  fs::rename(path_, taken, error);  // what is written from now on is another file
  if (error) return {};
  std::istringstream text(content_of(taken));
  fs::remove(taken, error);
  if (error) ++num_left_;  // a folder with something in it: nothing is renamed to that
  return lines_of(text);
}

bool stop_waits(const fs::path& control_file) {
  std::istringstream text(content_of(control_file));
  const std::vector<std::string> lines = lines_of(text);
  return std::any_of(lines.begin(), lines.end(),
                     [](const std::string& line) { return parse_command(line).kind == Command::Kind::stop; });
}

std::string ask_run(const fs::path& run_folder, const std::string& command, double patience) {
  const RunFolder folder{run_folder};
  demand_plain_folder(folder);
  std::error_code error;
  if (!fs::exists(folder.status(), error))
    throw no_answer(run_folder, "no run of breccia writes here", "the folder of a run in progress");
  run_folder::GrowingLines status(folder.status());
  // What stands there before the request answers none.
  do {
    for (const std::string& line : status.news().lines) {
      if (is_over(run_folder::parse_status_line(line)))
        throw no_answer(run_folder, "this run has ended", "the folder of a run in progress");
    }
  } while (status.has_more());
  if (fs::exists(lock_file(run_folder), error) && holder_of(run_folder).empty())
    throw no_answer(run_folder, "this run was interrupted: its process has ended", "the folder of a run in progress");
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience);
  const auto in_time = [&] { return std::chrono::steady_clock::now() < end; };
  const std::string id = std::to_string(::getpid()) + "." + std::to_string(::gettid()) + "." +
                         std::to_string(std::chrono::steady_clock::now().time_since_epoch().count());
  const std::string line = command + " id=" + id + "\n";
  const bool put = put_request(folder.control(), line, id, in_time);
  while (in_time()) {
    for (const std::string& line_of_run : status.news().lines) {
      const run_folder::StatusLine news = run_folder::parse_status_line(line_of_run);
      if (news.event && news.event->id == id) {
        if (news.event->accepted.value_or(false)) return news.event->text;
        throw no_answer(run_folder, "the run refuses: " + news.event->text, "");
      }
      if (is_over(news)) throw no_answer(run_folder, "the run has ended meanwhile", "");
    }
    std::this_thread::sleep_for(kPollInterval);
  }
  if (put && content_of(folder.control()) == line) fs::remove(folder.control(), error);
  throw no_answer(run_folder, "the run does not respond; it may have ended", "the folder of a run in progress");
}

}  // namespace breccia
