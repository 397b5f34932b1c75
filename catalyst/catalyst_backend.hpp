#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "catalyst/pipeline.hpp"
#include "catalyst/ranks.hpp"

namespace breccia::insitu {

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
  /// @param folder where its extracts go; exists
  /// @param channels mask of those that the script names; all of them may be asked for
  [[nodiscard]] std::unique_ptr<Pipeline> script(const std::string& name, const std::filesystem::path& file,
                                                 const std::filesystem::path& folder, std::uint32_t channels,
                                                 const std::map<std::string, double>& parameters);

 private:
  struct Session;
  const Ranks& ranks_;
  std::unique_ptr<Session> session_;
};

/// "ParaView Catalyst 5.11.0".
[[nodiscard]] const char* backend_description();

}  // namespace breccia::insitu
