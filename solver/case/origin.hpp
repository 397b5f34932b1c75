#pragma once

#include <map>
#include <string>

namespace breccia::case_ {

/// Where a key was written.
struct KeyPlace {
  std::string file;  ///< as the user named it, or "--set"
  int line = 0;
};

/// Place of an entry and its keys in the file, for messages of later checks (such as a group absent from the mesh).
struct Origin {
  int line = 0;
  std::string key;
  std::map<std::string, KeyPlace> keys{};  ///< "group", "displacement.x"
  /// Cases are equal if their settings are, regardless of their places in the file.
  friend bool operator==(const Origin&, const Origin&) { return true; }
};

}  // namespace breccia::case_
