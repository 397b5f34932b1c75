#pragma once

#include <filesystem>
#include <string>

#include "catalyst/conduit.hpp"

namespace breccia::insitu {

/// libcatalyst, opened. It is never closed: implementations do not survive being unloaded.
class Catalyst2Library {
 public:
  /// Opens the file that the environment's BRECCIA_LIBCATALYST names, else libcatalyst.so.3, where the loader finds it
  /// or in and above the folders of CATALYST_IMPLEMENTATION_PATHS; no case names it, so that none can bring its own
  /// code. Starts nothing. Throws PipelineError with the remedy if there is none, or it lacks a function.
  Catalyst2Library();

  [[nodiscard]] const ConduitFunctions& functions() const { return functions_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  /// CATALYST_IMPLEMENTATION_NAME, else "paraview".
  [[nodiscard]] const std::string& implementation() const { return implementation_; }
  /// Whether the implementation is ParaView's, which runs scripts.
  [[nodiscard]] bool is_paraview() const { return implementation_ == kParaView; }

  /// The implementation's file: libcatalyst-NAME.so in a folder of CATALYST_IMPLEMENTATION_PATHS or in catalyst/ beside
  /// libcatalyst, its default place. Throws PipelineError naming all that were tried.
  [[nodiscard]] std::filesystem::path implementation_file() const;

  static constexpr const char* kParaView = "paraview";

 private:
  ConduitFunctions functions_;
  std::filesystem::path file_;
  std::string implementation_;
};

/// What a status that libcatalyst returns means: "3 (the implementation is not found)".
[[nodiscard]] std::string words_of_status(int status);

}  // namespace breccia::insitu
