#pragma once

#include <sys/types.h>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace breccia::test {

/// What one call of the program gave.
struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

/// Runs a command of the shell.
Outcome outcome_of(const std::string& command);

/// Runs the built program. @param environment  "NAME=value ..." put before the command
Outcome call(const std::string& arguments, const std::string& environment = "");

/// Likewise on several ranks, which may be more than there are cores. @pre compiled with BRECCIA_MPIEXEC
/// @param environment  "NAME=value ...", of the ranks
Outcome call_ranks(int ranks, const std::string& arguments, const std::string& environment = "");
/// The same where each rank has arguments and environment of its own. Not by the colons of mpiexec, which crashes on
/// them in Open MPI 5.0.7.
struct RankCall {
  std::string arguments, environment;
};
Outcome call_each_rank(const std::vector<RankCall>& calls);
/// Starts the program on several ranks and does not wait for it. Returns the launcher, whose children the ranks are.
pid_t start_ranks(int ranks, const std::string& arguments, const std::string& environment = "");

/// Runs the built program and sends it a signal as soon as `ready` holds, after 50 s in any event. Returns its exit
/// code, -1 when the signal has killed it. @param arguments  may redirect its output
int call_interrupted(const std::string& arguments, int signal, const std::function<bool()>& ready);

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

/// A history.csv without the number of candidate couples, which depends on when they were searched: a division of the
/// model and a run that goes on search anew.
std::string history_without_couples(const std::filesystem::path& file);

/// A column of a history.csv by its name, such as "time [s]". Throws where there is none.
std::vector<double> history_column(const std::filesystem::path& file, const std::string& name);

/// What is wrong with the energies in a history.csv, empty if nothing: no dissipated term ever falls, and what is
/// kinetic and stored never exceeds what was there at first and was put in since.
std::string energy_fault(const std::filesystem::path& history);

}  // namespace breccia::test
