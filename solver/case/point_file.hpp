#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "base/time_function.hpp"

/// Points of a function of time from a text file of columns, as measuring devices, spreadsheets and scripts write them.
namespace breccia::case_ {

/// Larger files are refused, before they fill the memory; so are more points, which the case in the run folder holds.
inline constexpr std::size_t kMostPointFileBytes = 64U << 20U;
inline constexpr std::size_t kMostPoints = 100000, kMostPointsOfCase = 1000000;

struct FileColumn {
  std::string name;  ///< in the header, with or without its unit; empty: by number
  int number = 0;    ///< from 1
  std::string unit;  ///< of its numbers; empty: that of the header in [] or (), else SI
};

struct PointFile {
  std::filesystem::path file;
  FileColumn time, value;
  std::string si_unit;  ///< of the value
  double scale = 1;     ///< of the values
  double start = 0;     ///< s, time at which that of the file is 0
};

/// Columns are apart by semicolons, tabs, commas or blanks, whichever of these the first line has first in this order.
/// Lines that are empty or begin with #, % or ! are left out, and so are a byte order mark, a line "sep=;" and quotes
/// around a cell. The first line is a header where columns are named or neither of its two cells is a number. Numbers
/// have decimal points; what is too small for full precision is 0.
/// Throws InputError with one problem: the file cannot be read or is too large; a column is absent or named twice; a
/// unit does not fit; a line (named) with too few or too many columns, without a number, or not later than the one
/// before. Problems have no key.
[[nodiscard]] std::vector<TimeFunction::Point> read_points(const PointFile& source);

}  // namespace breccia::case_
