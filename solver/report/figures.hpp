#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace breccia::report {

/// What a number is that is missing.
inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// A picture, in the page's file itself.
struct Picture {
  std::string png;  ///< base64
  std::string title, text;
  double time = 0;  ///< s, simulated
};

/// Rows of a table that ParaView has found: numbers by name; vectors as their components x, y, z.
using Row = std::map<std::string, std::vector<double>>;

/// What ParaView has made of the frames (plugins/report/draw_report.py). Numbers that are missing are not in the maps,
/// or NaN in lists.
struct Figures {
  std::string paraview;               ///< its version; empty: there are no figures
  std::string missing;                ///< why there are none, or not all; with what helps
  std::vector<std::string> problems;  ///< of single parts
  double frames = 0, time = 0;        ///< how many, and of the last one, s
  std::vector<Picture> pictures;
  std::map<std::string, std::map<std::string, double>>
      facts;  ///< of "fragments", "cracks", "events", "contacts", "ranks"
  std::map<std::string, std::map<std::string, std::string>> texts;  ///< of these
  std::map<std::string, std::vector<Row>>
      tables;                         ///< "fragments.largest", "events.largest", "contacts.walls", "ranks.rows"
  std::map<std::string, Row> curves;  ///< "fragments.sieve", "events.magnitudes"

  /// NaN when it is not known.
  [[nodiscard]] double fact(const std::string& part, const std::string& name) const;
  /// Empty when there is none.
  [[nodiscard]] std::string text(const std::string& part, const std::string& name) const;
};

/// Reads figures.json and the pictures it names. A folder without that file gives no figures.
[[nodiscard]] Figures read_figures(const std::filesystem::path& folder);

}  // namespace breccia::report
