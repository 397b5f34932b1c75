#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace breccia {

/// A number that a script lets the outside set, as the script has it.
struct GeoParameter {
  std::string name;   ///< of the constant; empty: it has only a label
  std::string label;  ///< text after `Name`, which sets it as well; empty: none
  std::string value;  ///< its default, as written there; empty: not stated
  std::string words;  ///< comment behind it on its line
};

/// What a .geo script and the files it includes let the outside set, found by reading its words.
struct GeoScan {
  std::set<std::string>
      constants;  ///< names in DefineConstant[...] and in Exists(...): set before, they keep their value
  std::set<std::string> onelab_names;     ///< texts after `Name`: parameters of the form "Group/label"
  std::vector<GeoParameter> parameters;   ///< all of those, in the order of the script
  std::set<std::filesystem::path> files;  ///< the script itself and what it includes by name
  std::vector<Problem> problems;          ///< statements that are refused, with file and line
  std::string without_output;             ///< the script where it differs from the file; empty: it is read as it is
};

/// Reads a script. Comments and texts are skipped; `Include "file"` and `Merge "file.geo"` are followed relative to the
/// including file where the name is plain text. Refused: statements that run programs or end the process (SystemCall,
/// NonBlockingSystemCall, OnelabRun; Exit and Abort in a condition, a loop or an included file): a mesh is data, and
/// Exit would end the reading without a word. In the script itself the statements with which people end it (Save,
/// Print, Draw, Sleep, and everything from an Exit or Abort on) are left out of `without_output`, which keeps the
/// lines and names the files that it includes, and its folder, in full: it may be read from anywhere.
/// Refused as well: an included file that is no regular one or may not be read, more files or bytes than scripts have.
/// A file that is not there is left for gmsh to name. O(size), throws nothing but bad_alloc.
/// @param keep_output  what writes stays in `without_output`: the script is trusted
[[nodiscard]] GeoScan scan_geo(const std::filesystem::path& file, bool keep_output = false);

}  // namespace breccia
