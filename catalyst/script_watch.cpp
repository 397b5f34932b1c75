#include <Python.h>  // first: it sets macros that the system's headers heed; of VTK's, threads may be left out

#include "catalyst/script_watch.hpp"

#include <atomic>
#include <thread>

namespace breccia::insitu {
namespace {

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

/// Requests that Python calls interrupt() in the run's own thread. That thread keeps the interpreter lock unless
/// another one requests it, and handles pending calls when it gets it back. Waits until it returns to Python, so in a
/// thread of its own that is not joined; one at a time.
void ask_python(double limit) {
  overdue = limit;
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

ScriptWatch::ScriptWatch(double limit)
    : TurnWatch(limit, {.begin = [] { raised = false; }, .ask = &ask_python, .withdraw = [] { overdue = 0.0; }}) {}

bool ScriptWatch::interrupted() { return raised; }

}  // namespace breccia::insitu
