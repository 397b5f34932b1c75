#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace breccia {

/// Bytes that the copy writes at the moment at which its parent ends.
struct OrphanNote {
  int descriptor = -1;    ///< of a regular file that is open in the parent
  bool replaces = false;  ///< what the file holds; else they are appended
  std::string text;       ///< with "%PID%" for the number of the copy, once
};

/// A copy of this process (fork), with its memory as it is now, which survives it: mpiexec sends its ranks SIGTERM at
/// Ctrl-C and SIGKILL a second later, and knows the copy neither by number nor by session. It ignores the signals that
/// end a run. It keeps the descriptors of regular files, a lock (flock) on one of them included, and no others.
class SurvivingProcess {
 public:
  /// In the copy: the way to its parent.
  class Parent {
   public:
    Parent(int pipe, pid_t number) : pipe_(pipe), number_(number) {}
    [[nodiscard]] bool has_ended() const;
    /// To receive(), unless it has ended.
    void report(std::string_view text) const;

   private:
    int pipe_;
    pid_t number_;
  };

  /// @param work  is done in the copy, which ends with it. Threads are not copied: it takes no lock that one of them
  ///              may have had. Memory (malloc) and files are safe, libraries that no thread uses at the fork as well;
  ///              MPI and stdio are not
  explicit SurvivingProcess(const std::function<void(const Parent&)>& work, std::vector<OrphanNote> notes = {});
  SurvivingProcess(const SurvivingProcess&) = delete;
  SurvivingProcess& operator=(const SurvivingProcess&) = delete;
  ~SurvivingProcess();  ///< leaves it to itself

  [[nodiscard]] bool started() const { return process_ > 0; }  ///< false: the system has no process or memory for it
  /// Its next report; nullopt: it has ended without one.
  [[nodiscard]] std::optional<std::string> receive();
  void wait();  ///< for its end
  void kill();

 private:
  pid_t process_ = -1;
  int pipe_ = -1;
};

}  // namespace breccia
