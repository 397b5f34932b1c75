#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "catalyst/display.hpp"
#include "catalyst/parameter.hpp"
#include "catalyst/pipeline.hpp"
#include "catalyst/python_guard.hpp"
#include "catalyst/ranks.hpp"
#include "catalyst/script_watch.hpp"

namespace breccia::insitu {

struct ScriptDescription {
  std::string name;
  std::filesystem::path file;
  std::filesystem::path folder;  ///< where its extracts go; exists
  std::uint32_t channels = 0;    ///< mask of those that the script names; all of them may be requested
  Parameters parameters;
  python::About about;
  const Display* display = nullptr;  ///< on which it draws; null: it does not
};

/// ParaView Catalyst, started: needed by scripts and by the live link, not by the recordings. Once in a process:
/// ParaView cannot be started again after its end. Together with its source file this is all that knows vtkCPProcessor
/// and data descriptions.
class CatalystBackend {
 public:
  /// Starts ParaView on the ranks. Without MPI (see Ranks) it starts MPI too, since ParaView needs it, and ends it in
  /// the end. Collective. Throws PipelineError.
  explicit CatalystBackend(const Ranks& ranks);
  CatalystBackend(const CatalystBackend&) = delete;
  CatalystBackend& operator=(const CatalystBackend&) = delete;
  ~CatalystBackend();

  /// A script of version 2, exported from ParaView or written by hand. Starts Python at the first call. Collective.
  /// Throws PipelineError.
  [[nodiscard]] std::unique_ptr<Pipeline> script(ScriptDescription description);

 private:
  struct Session;
  const Ranks& ranks_;
  ScriptWatch watch_;
  std::unique_ptr<Session> session_;
};

/// "ParaView Catalyst 5.11.0".
[[nodiscard]] const char* backend_description();

}  // namespace breccia::insitu
