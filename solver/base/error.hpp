#pragma once

#include <cstddef>
#include <exception>
#include <string>
#include <vector>

namespace breccia {

/// Exit codes of the program.
enum class ExitCode : int { success = 0, usage = 1, input = 2, simulation = 3, internal = 4 };

/// One thing wrong with the case or the mesh. Empty parts are left out of the message; line 0 means unknown.
struct Problem {
  std::string file;
  int line = 0;
  std::string key;      ///< case key ("material[0].density") or mesh entity ("element 17")
  std::string what;     ///< what is wrong, in words
  std::string allowed;  ///< what is allowed
  std::string given;    ///< what was given

  /// "file:line: key: what; allowed: ...; given: ..."
  [[nodiscard]] std::string text() const;
};

/// Largest number of problems of one kind reported for one file or mesh.
inline constexpr std::size_t kProblemsNamed = 10;

/// Message for a std::bad_alloc.
[[nodiscard]] Problem out_of_memory();

/// Case or mesh cannot be run. Carries every problem found, not only the first. Exit code 2.
class InputError : public std::exception {
 public:
  explicit InputError(std::vector<Problem> problems);
  explicit InputError(Problem problem);
  [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }
  [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
  std::string text_;
};

/// The numbers went wrong in the run (NaN, energy residual past its limit, ...). Exit code 3.
/// The text names step, time, entity and remedy.
class SimulationError : public std::exception {
 public:
  explicit SimulationError(std::string text) : text_(std::move(text)) {}
  [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

/// Output could not be written (folder unreadable, disk full). Exit code 2.
class OutputError : public InputError {
  using InputError::InputError;
};

/// A broken promise of our own. Exit code 4.
class InternalError : public std::exception {
 public:
  explicit InternalError(std::string text) : text_(std::move(text)) {}
  [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

/// Throws InternalError; used by DEMAND and ASSERT.
[[noreturn]] void demand_failed(const char* condition, const char* file, int line, const std::string& detail);

}  // namespace breccia

/// Always on: a condition our own code guarantees. `detail` is a std::string with the values.
#define DEMAND(condition, detail)                                                       \
  do {                                                                                  \
    if (!(condition)) ::breccia::demand_failed(#condition, __FILE__, __LINE__, detail); \
  } while (false)

/// As DEMAND, in debug builds only.
#ifdef NDEBUG
#define ASSERT(condition, detail) \
  do {                            \
  } while (false)
#else
#define ASSERT(condition, detail) DEMAND(condition, detail)
#endif
