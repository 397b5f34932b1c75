#include "placements.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

namespace breccia::lab {

Placement::Placement(const std::string& experiment, std::size_t n, int spacing) {
  const auto edge = static_cast<std::size_t>(std::lround(std::cbrt(static_cast<double>(n))));
  const auto bodies = static_cast<double>(n);
  if (experiment == "I" || experiment == "II") {
    raster(edge, spacing);
  } else if (experiment == "III") {
    random(edge * edge * edge, {-1, -2000, -500000}, 3.0 * static_cast<double>(edge));
  } else if (experiment == "IV") {
    cells_.assign(n, BodyCell{});
    num_moving_axes_ = 0;
  } else if (experiment == "V") {
    random(n, {-1}, bodies / 4);
  } else if (experiment == "VI") {
    random(n, {-1, -1}, std::sqrt(3 * bodies));
  } else {
    throw std::invalid_argument("no experiment '" + experiment + "'");
  }
}

void Placement::raster(std::size_t edge, int spacing) {
  const auto at = [spacing](std::size_t i) { return static_cast<Coordinate>(i) * spacing; };
  cells_.reserve(edge * edge * edge);
  for (std::size_t x = 0; x < edge; ++x) {
    for (std::size_t y = 0; y < edge; ++y) {
      for (std::size_t z = 0; z < edge; ++z) cells_.push_back({at(x), at(y), at(z)});
    }
  }
}

void Placement::random(std::size_t n, const std::vector<std::int64_t>& seeds, double side) {
  num_moving_axes_ = seeds.size();
  std::vector<std::int64_t> states = seeds;
  cells_.assign(n, BodyCell{});
  for (BodyCell& cell : cells_) {
    for (std::size_t axis = 0; axis < states.size(); ++axis) {
      cell[axis] = static_cast<Coordinate>(side * generator_(states[axis]));
    }
  }
}

void Placement::move() {
  if (cells_.empty()) return;
  std::array<std::int64_t, 3> seeds{};
  for (std::size_t axis = 0; axis < 3; ++axis) seeds[axis] = start_ - cells_[0][axis];
  start_ -= 10;
  for (BodyCell& cell : cells_) {
    for (std::size_t axis = 0; axis < num_moving_axes_; ++axis) {
      const double alpha = generator_(seeds[axis]);
      cell[axis] += static_cast<Coordinate>(alpha + alpha);
    }
  }
}

}  // namespace breccia::lab
