#include "commands/commands.hpp"

#include <fmt/core.h>
#include <array>

#include "case/reader.hpp"
#include "commands/check_report.hpp"
#include "commands/json_report.hpp"
#include "commands/preview.hpp"
#include "commands/start_state.hpp"
#include "commands/terminal.hpp"
#include "output/insitu/insitu.hpp"

namespace breccia {
namespace {

constexpr std::size_t kMostAdvice = 5;  // without --all

int check(const CheckCommand& asked, int launched) {
  const std::optional<StartState> start = read_start_state(asked.case_file, asked.overrides, {});
  case_::Case input = read_case_of(asked.case_file, asked.overrides, start);
  input.mesh.trust = asked.trust_geometry;
  limit_preview(input);
  if (input.insitu.asked_for())
    preflight(input, std::filesystem::temp_directory_path(), InSituPlugin(input.insitu.backend), {});
  if (asked.ranks > 0) {
    const Model bare = build_bare_model(input);
    fmt::print("{}", asked.json ? domains_json(input, bare, asked.ranks) : domain_table(input, bare, asked.ranks));
    return 0;
  }
  if (asked.joints) {
    fmt::print("{}", joints_json(build_bare_model(input)));
    return 0;
  }
  const Model model = build_model(input);
  const Subject subject(input, model, start ? start->checkpoint.model.clock.time : 0.0);
  const CheckReport report = full_report(subject, start ? words_of(*start) : "");
  if (asked.json) {
    fmt::print("{}", check_json(subject, report));
    return 0;
  }
  print_lines(report.text + advice_list(report.advice, asked.all ? report.advice.size() : kMostAdvice));
  const std::array<int, 3>& n = input.domains.n;
  const int ranks = launched > 1 ? launched : n[0] * n[1] * n[2];  // the product is bounded by the case's validation
  if (ranks > 1) print_lines(domain_line(input, model, ranks));
  return 0;
}

}  // namespace

int check_command(const CheckCommand& asked, int launched) {
  return asked.json || asked.joints ? or_problems([&] { return check(asked, launched); }) : check(asked, launched);
}

}  // namespace breccia
