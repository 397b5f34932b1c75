#include "core/solver_problems.hpp"

#include <algorithm>

namespace breccia::gui {
namespace {

/// The piece of the text that a key names; the whole text where nothing stands there, as of a missing section.
std::string piece_of(const std::string& key, const TomlPlaces& places) {
  const Place* place = places.find(key);
  return place == nullptr ? places.text() : places.text().substr(place->entry.begin, place->entry.size());
}

bool has(const std::vector<Problem>& list, const Problem& wanted) {
  return std::any_of(list.begin(), list.end(),
                     [&](const Problem& p) { return p.key == wanted.key && p.what == wanted.what; });
}

}  // namespace

void SolverProblems::take(const QByteArray& asked, const std::vector<Problem>& problems) {
  if (problems.empty()) return;
  const TomlPlaces places(asked.toStdString());
  for (const Problem& p : problems) {
    const auto same = [&](const Told& told) { return told.problem.key == p.key && told.problem.what == p.what; };
    told_.erase(std::remove_if(told_.begin(), told_.end(), same), told_.end());
    told_.push_back({p, piece_of(p.key, places)});
  }
  text_ = asked;
}

bool SolverProblems::are_of_another_text(const Document& document) const {
  return !told_.empty() && text_ != document.text();
}

std::vector<Problem> SolverProblems::beside(const std::vector<Problem>& known, const Document& document) {
  const auto edited = [&](const Told& told) { return piece_of(told.problem.key, document.places()) != told.piece; };
  told_.erase(std::remove_if(told_.begin(), told_.end(), edited), told_.end());
  std::vector<Problem> found;
  for (const Told& told : told_) {
    if (has(known, told.problem)) continue;
    found.push_back(told.problem);
    if (const Place* place = document.places().find(told.problem.key)) found.back().line = place->line;
  }
  return found;
}

}  // namespace breccia::gui
