#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breccia::test {

/// What one call of the program gave.
struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

/// Runs the built program. @param environment  "NAME=value ..." put before the command
Outcome call(const std::string& arguments, const std::string& environment = "");

/// A folder of its own for one test, removed with the object.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return root_ / name; }
  /// Writes a file, returns its path quoted for the shell.
  std::string write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path root_;
};

/// A small case that runs in a fraction of a second: two boxes fly at each other, joints may break.
extern const std::string kSmallCase;

/// kSmallCase with the first occurrence of `from` replaced.
std::string changed(const std::string& from, const std::string& to);

std::string read_text(const std::filesystem::path& file);

}  // namespace breccia::test
