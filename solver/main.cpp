#include <malloc.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <system_error>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "commands/command_line.hpp"
#include "commands/environment.hpp"
#include "parallel/mpi_session.hpp"
#include "simulation/run.hpp"
#include "simulation/run_checkpoints.hpp"
#include "system/atomic_file.hpp"
#include "system/interruption.hpp"

namespace {

using namespace breccia;

int code(ExitCode exit_code) { return static_cast<int>(exit_code); }

volatile std::sig_atomic_t reports_signals = 0;  // one rank does

/// kEndingSignals end the run after the present step; a second one kills.
void stop_handler(int signal) {
  interruption = signal;
  stop_requested = true;
  std::signal(signal, SIG_DFL);
  if (!reports_signals) return;
  const char words[] = "\nbreccia: ending after the present step; a second signal ends at once\n";
  (void)!::write(STDERR_FILENO, words, sizeof words - 1);
}

/// A checkpoint is written during the run.
void checkpoint_handler(int) { checkpoint_requested = true; }

/// Freed memory is soon allocated again, above all when elements change ranks; getting large blocks anew from the
/// kernel each time costs more than the work on them.
void keep_freed_memory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

/// How a run, a resumption or a race shows its progress.
ProgressMode progress_mode(const std::string& name) {
  const std::map<std::string, ProgressMode> modes{{"bar", ProgressMode::bar},
                                                  {"log", ProgressMode::log},
                                                  {"json", ProgressMode::json},
                                                  {"none", ProgressMode::none}};
  const auto mode = modes.find(name);
  return mode != modes.end() ? mode->second : default_progress_mode(STDOUT_FILENO);
}

int dispatch(const std::string& command, Arguments& a, const Communicator& world, int argc, char** argv) {
  a.run.progress = a.resume.progress = a.race.progress = progress_mode(a.progress);
  a.run.command_line.assign(argv, argv + argc);
  a.resume.command_line = a.run.command_line;
  if (command == "run") return run_command(a.run, world);
  if (command == "resume") return resume_command(a.resume, world);
  if (command == "race") return race_command(a.race, world);
  if (command == "insitu replay") return replay_command(a.replay, world);
  if (!world.is_root()) return code(ExitCode::success);  // what follows is the work of one
  if (command == "check") return check_command(a.check, world.size());
  if (command == "mesh") return mesh_command(a.mesh);
  if (command == "diff") return diff_command(a.diff);
  if (command == "report") return report_command(a.report);
  if (command == "control") return control_command(a.control);
  if (command == "live") return live_command(a.live);
  if (command == "insitu info") return insitu_info_command();
  if (command == "guide") return guide_command(a.guide);
  if (command == "schema") return schema_command(a.schema_json);
  return explain_command(a.key, a.explain_all);
}

/// Prints what went wrong where `prints`: one rank for all.
int report(bool prints, const std::string& what, ExitCode exit_code) {
  if (prints) std::fprintf(stderr, "breccia: error: %s\n", printable_lines(what).c_str());
  return code(exit_code);
}

/// Standard output cannot be written, for example to a full disk. A pipe without a reader is not reported.
/// @param error  errno, 0 where it is not known
int lost_output(int error) {
  if (error == EPIPE) return exit_code_of(SIGPIPE);
  return report(true, output_error("standard output", "cannot be written", error).what(), ExitCode::input);
}

/// Writes out what a command has printed, which is its result, unlike that of a run.
/// @return  `done`, or the exit code where that fails
int with_output_written(int done) {
  errno = 0;
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  return written || done != 0 ? done : lost_output(errno);
}

/// Errors of the first three kinds are agreed upon: all ranks have the same one and one of them reports it. Others are
/// of one rank, and the rest would wait for it for ever.
int guarded(CommandLine& line, MpiSession& session, int argc, char** argv) {
  const bool root = session.world().is_root();
  int ended = 0;
  try {
    session.world().agree([] { check_environment(); });  // it need not be the same everywhere
    int done = dispatch(line.command, line.arguments, session.world(), argc, argv);
    if (line.command != "run" && line.command != "resume") done = with_output_written(done);
    return interruption != 0 && done == 0 ? exit_code_of(interruption) : done;
  } catch (const InputError& error) {
    const int refused = report(root, error.what(), ExitCode::input);
    return interruption != 0 ? exit_code_of(interruption) : refused;
  } catch (const SimulationError& error) {
    return report(root, error.what(), ExitCode::simulation);
  } catch (const std::bad_alloc&) {
    ended = report(true, out_of_memory().text(), ExitCode::input);
  } catch (const std::filesystem::filesystem_error& error) {  // a file or folder that cannot be used
    ended = report(true, error.what(), ExitCode::input);
  } catch (const std::system_error& error) {
    ended =
        std::ferror(stdout) != 0 ? lost_output(error.code().value()) : report(true, error.what(), ExitCode::internal);
  } catch (const NoResponse& error) {
    ended = report(true, error.what(), ExitCode::input);
  } catch (const std::exception& error) {
    ended = report(true, error.what(), ExitCode::internal);
  }
  session.abort(ended);
  return ended;
}

}  // namespace

int main(int argc, char** argv) {
  if (const std::string complaint = stack_problem(); !complaint.empty())  // MPI does not start then
    return report(true, complaint, ExitCode::input);
  keep_freed_memory();
  MpiSession session(argc, argv);
  CommandLine line = read_command_line(argc, argv);
  const bool root = session.world().is_root();
  if (!line.problem.empty()) return report(root, line.problem, ExitCode::usage);
  if (line.command.empty()) {  // the help, or the version
    if (root) std::fputs(line.answer.c_str(), stdout);
    return with_output_written(code(ExitCode::success));
  }
  // The others lose nothing when they are ended.
  const bool in_order = line.command == "run" || line.command == "resume" || line.command == "race";
  if (in_order) {
    reports_signals = root ? 1 : 0;
    for (const int s : kEndingSignals) handle_unless_ignored(s, stop_handler);
    std::signal(SIGUSR1, checkpoint_handler);
  }
  std::signal(SIGPIPE, SIG_IGN);  // the reader of the progress may end; the run continues
  std::signal(SIGXFSZ, SIG_IGN);  // a file over its limit is an error of the write, reported with the file's name
  const int ended = guarded(line, session, argc, argv);
  reports_signals = 0;  // mpiexec ends the ranks that are last to go where one has failed
  return ended;
}
