#include "commands/refusals.hpp"

#include <fmt/core.h>

#include "advice/constraint_words.hpp"
#include "advice/overlaps.hpp"
#include "base/error.hpp"
#include "case/problem_at.hpp"

namespace breccia {

void refuse_initial_overlaps(const case_::Case& input, const Model& model) {
  std::vector<Problem> problems;
  for (const GroupOverlap& groups : overlaps_by_groups(model)) {
    const case_::Contact& entry = overlap_entry(input, model, groups.deepest);
    if (entry.initial_overlap != case_::InitialOverlap::refuse) continue;
    problems.push_back(case_::problem_at(input, entry.origin, "initial_overlap", overlap_description(model, groups),
                                         overlap_remedy(groups.deepest), "refuse"));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

void refuse_contradictions(const case_::Case& input, const Model& model) {
  refuse_contradictions(input, constraint_conflicts(input, model));
}

void refuse_contradictions(const case_::Case& input, const std::vector<ConstraintConflict>& conflicts) {
  std::vector<Problem> problems;
  for (const ConstraintConflict& c : conflicts) {
    if (!c.whole) continue;
    problems.push_back({input.file.string(), c.later->origin.line, c.later->origin.key,
                        fmt::format("contradicts {}: all its {} nodes have another motion along {} here",
                                    name_of(*c.earlier), c.of_earlier, "xyz"[c.axis]),
                        fmt::format("one of them without {}", "xyz"[c.axis]),
                        fmt::format("{} of \"{}\"", kind_of(*c.later), c.later->group)});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace breccia
