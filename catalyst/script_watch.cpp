#include <Python.h>  // first: it sets macros that the system's headers heed; of VTK's, threads may be left out

#include "catalyst/script_watch.hpp"

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <thread>

namespace breccia::insitu {
namespace {

constexpr auto kBetweenLooks = std::chrono::seconds(1);
constexpr double kEnd = 3.0;     ///< times the limit: the program ends
constexpr int kFaultOfOurs = 4;  ///< exit code

/// s that the turn may take which is to be interrupted; 0: none is.
std::atomic<double> overdue{0.0};
std::atomic<bool> raised{false};

/// Called by Python between two instructions of the script.
int interrupt(void*) {
  const double limit = overdue.load();
  if (limit <= 0.0) return 0;  // it has come back meanwhile
  raised = true;
  PyErr_Format(PyExc_KeyboardInterrupt, "interrupted: it has taken more than %ld s (domains.patience)",
               static_cast<long>(limit));
  return -1;
}

/// Asks Python to call interrupt() in the run's own thread. That thread keeps Python to itself unless another one asks
/// for it, and looks at what is pending when it gets it back. Waits for as long as it does not come back to Python, so
/// in a thread that nobody waits for; one at a time.
void ask_python() {
  static std::atomic<bool> asking{false};
  if (asking.exchange(true)) return;
  std::thread([] {
    PyGILState_STATE state = PyGILState_Ensure();
    static_cast<void>(Py_AddPendingCall(&interrupt, nullptr));
    PyGILState_Release(state);
    asking = false;
  }).detach();
}

}  // namespace

ScriptWatch::ScriptWatch(double limit) : limit_(limit) {
  if (limit > 0.0) thread_.emplace(kBetweenLooks, [this] { look(); });
}

bool ScriptWatch::interrupted() const { return raised; }

void ScriptWatch::begin(const std::string& pipeline) {
  raised = false;
  if (!thread_) return;
  thread_->begin([&] {
    pipeline_ = pipeline;
    began_ = std::chrono::steady_clock::now();
  });
}

void ScriptWatch::restart() {
  if (!thread_) return;
  thread_->change([&] {
    began_ = std::chrono::steady_clock::now();
    overdue = 0.0;
  });
}

void ScriptWatch::end() {
  if (thread_) thread_->end([] { overdue = 0.0; });
}

void ScriptWatch::look() {
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - began_;
  if (taken < limit_) return;
  if (taken > kEnd * limit_) {
    std::fprintf(stderr,
                 "breccia: error: pipeline %s: has not come back for %.0f s and cannot be interrupted; the run ends "
                 "here\n",
                 pipeline_.c_str(), taken.count());
    ::_exit(kFaultOfOurs);
  }
  overdue = limit_.count();
  ask_python();
}

}  // namespace breccia::insitu
