#include <vtkPython.h>  // first: it sets macros that the system's headers heed

#include "catalyst/python_guard.hpp"

#include <vtkLogger.h>
#include <vtkPythonInterpreter.h>
#include <vtkSmartPyObject.h>

#include "catalyst/display.hpp"
#include "catalyst/messages.hpp"
#include "catalyst/pipeline_error.hpp"
#include "catalyst/whole_file.hpp"

namespace breccia::insitu::python {
namespace {

constexpr const char* kGuard = "breccia_guard";
constexpr const char* kOutput = "breccia_output";

/// Of the scripts' turns.
ScriptWatch* script_watch = nullptr;

/// Waiting for others is no work of the script's.
struct Waiting {
  Waiting() { script_watch->restart(); }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;
  ~Waiting() { script_watch->restart(); }
};

/// What the wait for other ranks ended with, once it has ended in vain.
std::string abandoned;

/// Python's agree(text): whether any rank brings a text.
PyObject* agree(PyObject* ranks, PyObject* text) {
  const char* mine = PyUnicode_AsUTF8(text);
  if (mine == nullptr) {
    PyErr_Clear();
    mine = "an error without a text";
  }
  try {
    if (!abandoned.empty()) throw Abandoned(abandoned);
    const Waiting waiting;
    return PyBool_FromLong(static_cast<const Ranks*>(PyCapsule_GetPointer(ranks, nullptr))->agree(mine).empty() ? 0
                                                                                                                : 1);
  } catch (const Abandoned& error) {
    abandoned = error.what();
    PyErr_SetString(PyExc_RuntimeError, error.what());
    return nullptr;
  }
}
PyMethodDef agree_method{"agree", agree, METH_O, nullptr};

/// Python's spare(address of an X display).
PyObject* spare(PyObject*, PyObject* address) {
  spare_process(PyLong_AsVoidPtr(address));
  PyErr_Clear();
  Py_RETURN_NONE;
}
PyMethodDef spare_method{"spare", spare, METH_O, nullptr};

/// Type and message of the exception that Python has raised to us; it is cleared.
std::string raised() {
  PyObject* type = nullptr;
  PyObject* value = nullptr;
  PyObject* trace = nullptr;
  PyErr_Fetch(&type, &value, &trace);
  const vtkSmartPyObject text(value == nullptr ? nullptr : PyObject_Str(value));
  const char* what = text ? PyUnicode_AsUTF8(text) : nullptr;
  std::string line = type == nullptr ? "unknown" : reinterpret_cast<PyTypeObject*>(type)->tp_name;
  if (what != nullptr) line += std::string(": ") + what;
  Py_XDECREF(type);
  Py_XDECREF(value);
  Py_XDECREF(trace);
  PyErr_Clear();
  return one_line(line);
}

/// Calls function(arguments) of a module; `arguments` is a tuple, which is released. Throws PipelineError with what it
/// raises.
vtkSmartPyObject call(const char* function, PyObject* arguments, const char* of_module = kGuard) {
  const vtkSmartPyObject tuple(arguments);
  const vtkSmartPyObject module(PyImport_ImportModule(of_module));
  const vtkSmartPyObject callable(module ? PyObject_GetAttrString(module, function) : nullptr);
  vtkSmartPyObject result(callable && tuple ? PyObject_CallObject(callable, tuple) : nullptr);
  if (!result) throw PipelineError("Python: " + raised());
  return result;
}

}  // namespace

void start(const std::filesystem::path& pipelines, const std::filesystem::path& guard, const Ranks& ranks,
           ScriptWatch& watch) {
  script_watch = &watch;
  vtkPythonInterpreter::Initialize();
  // ParaView's Python takes its level of logging from VTK's when it is imported; it does not understand "off" and would
  // log all.
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_ERROR);
  const vtkPythonScopeGilEnsurer lock;
  vtkPythonInterpreter::PrependPythonPath(pipelines.c_str());
  vtkPythonInterpreter::PrependPythonPath(guard.c_str());
  const vtkSmartPyObject capsule(PyCapsule_New(const_cast<Ranks*>(&ranks), nullptr, nullptr));
  call("install",
       Py_BuildValue("(NN)", PyCFunction_New(&agree_method, capsule), PyCFunction_New(&spare_method, nullptr)));
  capture_messages();
}

void enter(const std::string& name, const std::filesystem::path& script, const std::filesystem::path& folder,
           const Parameters& parameters, const About& about) {
  const vtkPythonScopeGilEnsurer lock;
  PyObject* values = PyDict_New();
  for (const auto& [key, value] : parameters) {
    PyObject* number = value.is_number() ? PyFloat_FromDouble(value.number) : Py_BuildValue("");
    const vtkSmartPyObject pair(Py_BuildValue("(Nz)", number, value.text ? value.text->c_str() : nullptr));
    PyDict_SetItemString(values, key.c_str(), pair);
  }
  call("enter", Py_BuildValue("(sssN{sssdsd})", name.c_str(), script.c_str(), folder.c_str(), values, "title",
                              about.title.c_str(), "end", about.end, "strength", about.strength));
}

std::string take_error() {
  const vtkPythonScopeGilEnsurer lock;
  if (!abandoned.empty()) throw Abandoned(abandoned);
  const vtkSmartPyObject text = call("take_error", PyTuple_New(0));
  const char* line = PyUnicode_AsUTF8(text);
  return line == nullptr ? raised() : std::string(line);
}

bool usable() {
  const vtkPythonScopeGilEnsurer lock;
  return PyObject_IsTrue(call("usable", PyTuple_New(0))) == 1;
}

void add_output(const std::string& text, Output kind) {
  const vtkPythonScopeGilEnsurer lock;
  // Bytes that are no UTF-8 are replaced, as by Python's own streams.
  PyObject* const words = PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
  call(kind == Output::warning ? "warn" : "record", Py_BuildValue("(N)", words), kOutput);
}

std::string take_output(const std::filesystem::path& folder) {
  const vtkPythonScopeGilEnsurer lock;
  const vtkSmartPyObject text = call("take", Py_BuildValue("(s)", folder.c_str()), kOutput);
  const char* lines = PyUnicode_AsUTF8(text);
  return lines == nullptr ? raised() : std::string(lines);
}

}  // namespace breccia::insitu::python
