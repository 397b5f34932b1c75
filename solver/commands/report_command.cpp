#include <fmt/chrono.h>
#include <fmt/core.h>

#include <chrono>
#include <ctime>

#include "base/error.hpp"
#include "commands/commands.hpp"
#include "output/atomic_file.hpp"
#include "report/drawing.hpp"
#include "report/page.hpp"
#include "report/record.hpp"

namespace breccia {

int report_command(const ReportCommand& asked) {
  const report::RunRecord run = report::read_run(asked.run);
  report::Figures figures;
  if (asked.no_pictures)
    figures.missing = "not asked for (--no-pictures)";
  else
    figures = report::draw_run(asked.run, run.up, std::chrono::seconds(asked.time_limit));
  const std::filesystem::path file = asked.file.empty() ? asked.run / "report.html" : asked.file;
  const std::string made = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  write_file_atomically(file, report::page_of(run, figures, made));
  if (!asked.no_pictures && !figures.missing.empty()) fmt::print(stderr, "breccia: {}\n", figures.missing);
  fmt::print("report in {}\n", file.string());
  return 0;
}

}  // namespace breccia
