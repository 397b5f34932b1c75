#pragma once

#include <QString>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "core/document.hpp"

namespace breccia::gui {

/// What the solver's commands have found wrong with the case and its reader has not, since it depends on the mesh. Each
/// problem holds until what it is about is edited, or the solver is content.
class SolverProblems {
 public:
  /// @param asked  text of the case that they were found in
  /// @pre  each has a key
  void take(const QByteArray& asked, const std::vector<Problem>& problems);
  void clear() { told_.clear(); }
  [[nodiscard]] bool empty() const { return told_.empty(); }
  /// Some are of a text that has been edited since, though not where they point to: the edit may have solved them.
  [[nodiscard]] bool are_of_another_text(const Document& document) const;
  /// Forgets what has been edited, and returns the others, at the lines where they stand now, that are not in `known`.
  [[nodiscard]] std::vector<Problem> beside(const std::vector<Problem>& known, const Document& document);

 private:
  struct Told {
    Problem problem;
    std::string piece;  ///< of the case, that it is about
  };
  std::vector<Told> told_;
  QByteArray text_;  ///< of the case when the last ones were reported
};

}  // namespace breccia::gui
