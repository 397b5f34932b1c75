#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace breccia::insitu {

/// A parameter of a pipeline as it was written: a number, or a text, which may read as a quantity and is both then.
struct Parameter {
  double number = std::numeric_limits<double>::quiet_NaN();  ///< SI; NaN: the text reads as none
  std::optional<std::string> text;                           ///< nothing: it was written as a number

  [[nodiscard]] bool is_number() const { return !std::isnan(number); }
};
using Parameters = std::map<std::string, Parameter>;

/// Kind of a parameter in a script, by its default.
enum class ParameterKind { any, number, text };
using KnownParameters = std::map<std::string, std::set<ParameterKind>>;

}  // namespace breccia::insitu
