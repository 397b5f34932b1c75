#include "report/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "report/axis.hpp"
#include "report/html.hpp"

namespace breccia::report {
namespace {

constexpr double kLeft = 62, kRight = 14, kTop = 10, kBelow = 46, kLegendRow = 20;
constexpr std::size_t kMostPoints = 800;  // of a line: twice as many as there are pixels of a common screen in it
// Distinguishable with colour blindness, and in grey by their dashes (lines) and order (areas).
constexpr std::array<const char*, 12> kColours{"#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7", "#56b4e9",
                                               "#8c6d1f", "#5e3c99", "#b2182b", "#4d4d4d", "#7fbc41", "#999999"};
constexpr std::array<const char*, 4> kDashes{"", "8 3", "2 3", "9 3 2 3"};

std::string colour_of(std::size_t i) { return kColours[i % kColours.size()]; }

/// Indices that are kept of n values: all, or the least and largest of each of many equal stretches.
std::vector<std::size_t> kept(const std::vector<double>& y) {
  std::vector<std::size_t> indices;
  const std::size_t n = y.size();
  if (n <= kMostPoints) {
    for (std::size_t i = 0; i < n; ++i) indices.push_back(i);
    return indices;
  }
  constexpr std::size_t kStretches = kMostPoints / 2;
  for (std::size_t k = 0; k < kStretches; ++k) {
    const std::size_t from = k * n / kStretches, to = (k + 1) * n / kStretches;
    const auto begin = y.begin() + static_cast<std::ptrdiff_t>(from), end = y.begin() + static_cast<std::ptrdiff_t>(to);
    const auto [least, most] = std::minmax_element(begin, end);
    auto a = static_cast<std::size_t>(least - y.begin()), b = static_cast<std::size_t>(most - y.begin());
    if (k == 0) a = 0;
    if (k + 1 == kStretches) b = n - 1;
    if (a > b) std::swap(a, b);
    indices.push_back(a);
    if (b != a) indices.push_back(b);
  }
  return indices;
}

/// Size in pixels of a screen.
struct Sheet {
  double width, plot;  ///< of all, and height of what the axes span
};
Sheet sheet_of(const Chart& chart) { return chart.stacked ? Sheet{860, 280} : Sheet{440, 230}; }

struct Frame {
  Sheet sheet;
  Axis x, y;
  [[nodiscard]] double px(double value) const { return kLeft + x.place(value) * (sheet.width - kLeft - kRight); }
  [[nodiscard]] double py(double value) const { return kTop + (1 - y.place(value)) * sheet.plot; }
  [[nodiscard]] bool holds(double vx, double vy) const {
    return std::isfinite(vx) && std::isfinite(vy) && (!x.logarithmic || vx > 0) && (!y.logarithmic || vy > 0);
  }
};

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void take(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// Series with as many x as y, those of a stacked chart as the sums up to them.
std::vector<Series> summed(const Chart& chart) {
  std::vector<Series> all = chart.series;
  for (Series& series : all) {
    const std::size_t n = std::min(series.x.size(), series.y.size());
    series.x.resize(n);
    series.y.resize(n);
  }
  if (!chart.stacked) return all;
  std::vector<double> sum;
  for (Series& series : all) {
    if (series.reference) continue;
    sum.resize(std::max(sum.size(), series.y.size()));
    for (std::size_t i = 0; i < series.y.size(); ++i) series.y[i] = sum[i] += series.y[i];
  }
  return all;
}

Axis axis_of(const Range& range, bool logarithmic, const std::string& name, const std::string& unit) {
  return logarithmic ? logarithmic_axis(range.low, range.high, name, unit)
                     : linear_axis(range.low, range.high, name, unit);
}

std::string line_path(const Series& series, const Frame& frame) {
  std::string path;
  bool pen_down = false;
  for (const std::size_t i : kept(series.y)) {
    if (!frame.holds(series.x[i], series.y[i])) {
      pen_down = false;
      continue;
    }
    path += fmt::format("{}{:.1f} {:.1f}", pen_down ? "L" : "M", frame.px(series.x[i]), frame.py(series.y[i]));
    pen_down = true;
  }
  return path;
}

/// @param below  the sum under this one; null: the axis
std::string area_path(const Series& series, const Series* below, const Frame& frame) {
  std::string path, back;
  const std::vector<std::size_t> indices = kept(series.y);
  for (const std::size_t i : indices)
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", frame.px(series.x[i]), frame.py(series.y[i]));
  for (auto i = indices.rbegin(); i != indices.rend(); ++i)
    back += fmt::format("L{:.1f} {:.1f}", frame.px(series.x[*i]), frame.py(below != nullptr ? below->y[*i] : 0.0));
  return path.empty() ? path : path + back + "Z";
}

std::string grid(const Frame& frame) {
  std::string text = "<g class=\"grid\">";
  const double bottom = kTop + frame.sheet.plot, right = frame.sheet.width - kRight;
  for (std::size_t i = 0; i < frame.x.marks.size(); ++i) {
    const double at = frame.px(frame.x.marks[i]);
    text += fmt::format("<path d=\"M{0:.1f} {1}V{2}\"/><text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4}</text>",
                        at, kTop, bottom, bottom + 16, frame.x.labels[i]);
  }
  for (std::size_t i = 0; i < frame.y.marks.size(); ++i) {
    const double at = frame.py(frame.y.marks[i]);
    text += fmt::format("<path d=\"M{0} {1:.1f}H{2}\"/><text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>",
                        kLeft, at, right, kLeft - 6, at + 4, frame.y.labels[i]);
  }
  text += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>", (kLeft + right) / 2, bottom + 36,
                      escaped(frame.x.title));
  text += fmt::format("<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text></g>\n",
                      kTop + frame.sheet.plot / 2, escaped(frame.y.title));
  return text;
}

std::string drawn(const Chart& chart, const std::vector<Series>& all, const Frame& frame) {
  std::string text;
  const Series* below = nullptr;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Series& series = all[i];
    const std::string colour = series.reference ? "#1b1d21" : colour_of(i);
    if (chart.stacked && !series.reference) {
      text += fmt::format("<path d=\"{}\" fill=\"{}\" fill-opacity=\"0.85\" stroke=\"#fff\" stroke-width=\"0.6\"/>\n",
                          area_path(series, below, frame), colour);
      below = &series;
    } else if (series.points) {
      for (std::size_t k = 0; k < series.x.size(); ++k) {
        if (frame.holds(series.x[k], series.y[k]))
          text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\" fill=\"{}\"/>", frame.px(series.x[k]),
                              frame.py(series.y[k]), colour);
      }
    } else {
      const char* dash = series.reference ? "5 3" : kDashes[i % kDashes.size()];
      text +=
          fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.7\"{}/>\n", line_path(series, frame),
                      colour, *dash != '\0' ? fmt::format(" stroke-dasharray=\"{}\"", dash) : "");
    }
  }
  return text;
}

/// Swatches and names, in rows. @return  the text and how high it is
std::pair<std::string, double> legend(const Chart& chart) {
  if (chart.series.size() < 2) return {"", 0};
  std::string text = "<g class=\"legend\">";
  const Sheet sheet = sheet_of(chart);
  double x = kLeft, y = kTop + sheet.plot + kBelow + 12;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const Series& series = chart.series[i];
    const double width = 40 + 6.8 * static_cast<double>(series.name.size());
    if (x > kLeft && x + width > sheet.width) {
      x = kLeft;
      y += kLegendRow;
    }
    const std::string colour = series.reference ? "#1b1d21" : colour_of(i);
    const char* dash = series.reference ? "5 3" : kDashes[i % kDashes.size()];
    if (chart.stacked && !series.reference)
      text += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"12\" height=\"12\" fill=\"{}\"/>", x + 4, y - 10,
                          colour);
    else if (series.points)
      text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>", x + 10, y - 4, colour);
    else
      text += fmt::format(
          "<path d=\"M{:.1f} {:.1f}h20\" stroke=\"{}\" stroke-width=\"2\" stroke-dasharray=\"{}\" fill=\"none\"/>", x,
          y - 4, colour, *dash != '\0' ? dash : "none");
    text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", x + 25, y, escaped(series.name));
    x += width;
  }
  return {text + "</g>\n", y - (kTop + sheet.plot + kBelow) + 8};
}

std::string described(const Chart& chart, const Range& x, const Range& y) {
  std::string names;
  for (const Series& series : chart.series) names += (names.empty() ? "" : ", ") + series.name;
  return fmt::format("{} from {} to {}, {} from {} to {}. Shown: {}.", chart.y_name, quantity(y.low, chart.y_unit),
                     quantity(y.high, chart.y_unit), chart.x_name, quantity(x.low, chart.x_unit),
                     quantity(x.high, chart.x_unit), names);
}

}  // namespace

std::string svg_of(const Chart& chart) {
  const std::vector<Series> all = summed(chart);
  Range x, y;
  for (const Series& series : all) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      const double vx = series.x[i], vy = series.y[i];
      if (!std::isfinite(vx) || !std::isfinite(vy) || (chart.log_x && vx <= 0) || (chart.log_y && vy <= 0)) continue;
      x.take(vx);
      y.take(vy);
    }
  }
  if (x.low > x.high) return {};
  if (chart.stacked) y.take(0);
  const Sheet sheet = sheet_of(chart);
  const Frame frame{sheet, axis_of(x, chart.log_x, chart.x_name, chart.x_unit),
                    axis_of(y, chart.log_y, chart.y_name, chart.y_unit)};
  const auto [key, height] = legend(chart);
  return fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\">\n<title>{}</title>\n<desc>{}</desc>\n",
                     sheet.width, kTop + sheet.plot + kBelow + height, escaped(chart.title),
                     escaped(described(chart, x, y))) +
         grid(frame) + drawn(chart, all, frame) + key + "</svg>\n";
}

std::string bar(double share) {
  const double width = 120 * std::clamp(std::isfinite(share) ? share : 0.0, 0.0, 1.0);
  return fmt::format(
      "<svg class=\"bar\" viewBox=\"0 0 120 10\" aria-hidden=\"true\"><rect width=\"120\" height=\"10\" "
      "fill=\"#e6e9ed\"/>"
      "<rect width=\"{:.1f}\" height=\"10\" fill=\"#0072b2\"/></svg>",
      width);
}

}  // namespace breccia::report
