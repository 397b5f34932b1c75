#include <fmt/chrono.h>
#include <fmt/core.h>

#include <chrono>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <system_error>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "commands/commands.hpp"
#include "commands/terminal.hpp"
#include "report/drawing.hpp"
#include "report/page.hpp"
#include "report/record.hpp"
#include "system/atomic_file.hpp"
#include "system/regular_file.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// Whether nothing is lost that is no page: an empty file is none.
bool is_page_or_empty(const fs::path& file) {
  constexpr std::string_view kBegin = "<!DOCTYPE html";
  std::string begin(kBegin.size(), '\0');
  RegularStream in(file, Depth::named);
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return (in.eof() && in.gcount() == 0) || begin == kBegin;
}

OutputError refused(const fs::path& file, const std::string& what) {
  return OutputError(Problem{file.string(), 0, "", what, "a new file, or an earlier page to be replaced", ""});
}

/// The file that a name leads to: what is written there replaces it, which must befall no link, device or pipe, and no
/// case or history that was named by mistake. A link is followed where the user has named it, not in a run's folder,
/// which may be another's.
fs::path replaceable(const fs::path& file, const fs::path& run) {
  std::error_code error;
  const bool is_link = fs::is_symlink(file, error);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (is_link && fs::equivalent(folder, run, error)) throw refused(file, "this is a symbolic link in a run's folder");
  const fs::file_status status = fs::status(file, error);
  if (!is_link && !fs::exists(status)) return file;
  if (!fs::is_regular_file(status)) throw refused(file, "this is no regular file");
  if (!is_page_or_empty(file)) throw refused(file, "this file is no page");
  return is_link ? fs::canonical(file) : file;
}

}  // namespace

int report_command(const ReportCommand& asked) {
  const fs::path file = replaceable(asked.file.empty() ? asked.run / "report.html" : asked.file, asked.run);
  const report::RunRecord run = report::read_run(asked.run);
  report::Figures figures;
  if (asked.no_pictures)
    figures.missing = "not requested (--no-pictures)";
  else
    figures = report::draw_run(asked.run, run.up, std::chrono::seconds(asked.time_limit));
  const std::string made = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  write_file_atomically(file, report::page_of(run, figures, made));
  if (!asked.no_pictures && !figures.missing.empty())
    std::cerr << "breccia: " << printable_lines(figures.missing) << '\n';
  print_lines("report in " + file.string() + "\n");
  return 0;
}

}  // namespace breccia
