#include "widgets/condition_glyphs.hpp"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "widgets/run_panel.hpp"

namespace breccia::gui {
namespace {

using Vector = std::array<double, 3>;

double size(const Vector& v) { return std::hypot(v[0], v[1], v[2]); }

QString text(const char* words) { return QCoreApplication::translate("conditions", words); }

std::string words_of(const QString& pattern, double value, const QString& unit) {
  return pattern.arg(quantity_words(value, unit)).toStdString();
}

/// "stretched", "compressed" or both.
QString stretching_words(const Vector& rates) {
  const auto [least, most] = std::minmax_element(rates.begin(), rates.end());
  if (*least >= 0) return text("stretched at up to %1");
  return *most <= 0 ? text("compressed at up to %1") : text("stretched and compressed at up to %1");
}

/// Parts of an initial velocity beside that of all points alike.
void add_parts(const Condition& row, const Load& whole, std::vector<Load>& loads) {
  const auto add = [&](LoadShape shape, const Vector& direction, const std::string& words) {
    loads.push_back({shape, whole.group, direction, {}, words, row.densities});
  };
  if (row.random > 0) add(LoadShape::random, {}, words_of(text("random velocities up to %1"), row.random, "m/s"));
  if (const double turn = size(row.turns_by); turn > 0)
    add(LoadShape::spin, row.turns_by, words_of(text("turns by %1 about this axis"), turn, "rad/s"));
  if (!(size(row.stretches_by) > 0)) return;
  double most = 0;
  for (const double rate : row.stretches_by) most = std::max(most, std::abs(rate));
  add(LoadShape::stretch, row.stretches_by, words_of(stretching_words(row.stretches_by), most, "1/s"));
}

/// Along an axis, the nearest one.
Vector along_axis(const Vector& direction) {
  const auto larger = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto most = std::max_element(direction.begin(), direction.end(), larger);
  Vector axis{};
  axis[static_cast<std::size_t>(most - direction.begin())] = *most < 0 ? -1 : 1;
  return axis;
}

}  // namespace

std::vector<Load> glyphs_of(const Condition& row) {
  Load load{LoadShape::arrow, row.target.toStdString(), row.largest, {}, {}};
  load.words = (row.type + " " + quantity_words(size(row.largest), row.unit)).toStdString();
  if (row.absorbs) {
    load.shape = LoadShape::absorbing;
    load.words = row.type.toStdString();
  } else if (row.follows) {
    load.shape = LoadShape::pressure;
    load.words = (row.type + " " + quantity_words(row.largest[0], row.unit)).toStdString();
  } else if (row.number < 0) {
    load.shape = LoadShape::double_arrow;
  } else if (!row.target.isEmpty() && !(size(row.largest) > 0)) {  // fixed, or without motion
    load.shape = LoadShape::support;
    load.axes = row.axes;
    load.words = (row.type + " " + row.value).toStdString();
  }
  std::vector<Load> loads{load};
  if (row.number < 0) add_parts(row, load, loads);
  return loads;
}

std::array<double, 3> up_of(const Document& document, const std::vector<Condition>& conditions) {
  constexpr Vector kY{0, 1, 0}, kZ{0, 0, 1};
  const auto is_plane = [](const Place& place) { return place.path.starts_with("plane"); };
  const auto& places = document.places().all();
  if (std::any_of(places.begin(), places.end(), is_plane)) return kY;
  for (const Condition& row : conditions) {
    if (!row.is_gravity || !(size(row.largest) > 0)) continue;
    const Vector down = along_axis(row.largest);
    return {0 - down[0], 0 - down[1], 0 - down[2]};
  }
  const auto falls = [&](const Condition& row) {
    return row.number < 0 && size(row.largest) > 0 && along_axis(row.largest) == Vector{0, 0, -1};
  };
  return std::any_of(conditions.begin(), conditions.end(), falls) ? kZ : kY;
}

}  // namespace breccia::gui
