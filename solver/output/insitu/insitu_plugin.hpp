#pragma once

#include <filesystem>
#include <string>

#include "case/case.hpp"
#include "catalyst/insitu_abi.h"

namespace breccia {

/// An in-situ adaptor as a library that is opened only for runs that need it, since its dependencies (ParaView, Python)
/// take about 200 MB a process.
class InSituPlugin {
 public:
  /// Opens the adaptor of insitu.backend. With "auto" that is the one with ParaView linked, or, where that cannot be
  /// loaded, the one for Catalyst 2, if libcatalyst and its implementation are found. Throws OutputError with the
  /// package to install when it is missing, cannot be loaded or is of another version.
  explicit InSituPlugin(case_::InSituBackend backend);
  [[nodiscard]] const BrecciaInsituApi& api() const { return *api_; }

  /// What it finds to work with, a line each. Throws OutputError with what lacks.
  [[nodiscard]] std::string found() const;

  /// Its search path: the environment's BRECCIA_CATALYST or BRECCIA_CATALYST2, or relative to the folder of the
  /// program: ../lib/breccia where both are installed, ../catalyst where they were built.
  [[nodiscard]] static std::filesystem::path place(case_::InSituBackend backend);

 private:
  void open(case_::InSituBackend backend);

  const BrecciaInsituApi* api_ = nullptr;  // never closed: VTK does not survive being unloaded
};

}  // namespace breccia
