#include <fmt/chrono.h>
#include <fmt/core.h>

#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <string_view>
#include <system_error>

#include "base/error.hpp"
#include "commands/commands.hpp"
#include "output/atomic_file.hpp"
#include "report/drawing.hpp"
#include "report/page.hpp"
#include "report/record.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// Whether nothing is lost that is no page: an empty file is none.
bool is_page_or_empty(const fs::path& file) {
  constexpr std::string_view kBegin = "<!DOCTYPE html";
  std::string begin(kBegin.size(), '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return (in.eof() && in.gcount() == 0) || begin == kBegin;
}

/// The file that a name leads to: what is written there replaces it, which must befall no link, device or pipe, and no
/// case or history that was named by mistake.
fs::path replaceable(const fs::path& file) {
  std::error_code error;
  const bool is_link = fs::is_symlink(file, error);
  const fs::file_status status = fs::status(file, error);
  if (!is_link && !fs::exists(status)) return file;
  if (!fs::is_regular_file(status))
    throw OutputError(
        Problem{file.string(), 0, "", "this is no regular file", "a new file, or an earlier page to be replaced", ""});
  if (!is_page_or_empty(file))
    throw OutputError(
        Problem{file.string(), 0, "", "this file is no page", "a new file, or an earlier page to be replaced", ""});
  return is_link ? fs::canonical(file) : file;
}

}  // namespace

int report_command(const ReportCommand& asked) {
  const fs::path file = replaceable(asked.file.empty() ? asked.run / "report.html" : asked.file);
  const report::RunRecord run = report::read_run(asked.run);
  report::Figures figures;
  if (asked.no_pictures)
    figures.missing = "not asked for (--no-pictures)";
  else
    figures = report::draw_run(asked.run, run.up, std::chrono::seconds(asked.time_limit));
  const std::string made = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  write_file_atomically(file, report::page_of(run, figures, made));
  if (!asked.no_pictures && !figures.missing.empty()) std::cerr << "breccia: " << figures.missing << '\n';
  fmt::print("report in {}\n", file.string());
  return 0;
}

}  // namespace breccia
