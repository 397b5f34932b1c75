#pragma once

#include <QString>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "base/time_function.hpp"
#include "core/document.hpp"
#include "core/plot_line.hpp"

namespace breccia::gui {

/// A load or constraint of the case.
struct Condition {
  QString path;   ///< "stage[0].constraint[1]"
  QString stage;  ///< name, or its number from 1; empty: before the first one
  /// "gravity", "fixed", "velocity", "displacement", "pressure", "traction", "force", "absorbing", "initial velocity"
  QString type;
  QString target;  ///< group or surface; empty: everything
  QString value;   ///< as it stands in the case
  QString unit;    ///< of the curves
  /// Functions of time over their stage, s and SI; empty: it is none.
  std::vector<PlotLine> curves;
  int number = -1;  ///< of the stage, from 0; -1: before the first one
  bool is_gravity = false;
  bool absorbs = false;                  ///< a boundary that waves leave through
  bool follows = false;                  ///< a pressure, which acts along the normals of its faces
  std::array<bool, 3> axes{};            ///< that are prescribed
  std::array<double, 3> largest{};       ///< value by axis where it is largest over the stage, SI; a pressure has one
  std::array<double, 3> turns_by{};      ///< rad/s, of an initial velocity
  std::array<double, 3> stretches_by{};  ///< 1/s, of an initial velocity
  std::map<std::string, double> densities{};  ///< kg/m3, by volume group, of an initial velocity
  double random = 0;                          ///< greatest speed that is drawn for a body, m/s, of an initial velocity
};

/// A function of time from `begin` to `end`, s, with the corners of its table.
[[nodiscard]] PlotLine sampled(const QString& name, const TimeFunction& function, double begin, double end);

/// All of them, stage by stage. Empty where the reader refuses the case.
[[nodiscard]] std::vector<Condition> conditions_of(const Document& document);

}  // namespace breccia::gui
