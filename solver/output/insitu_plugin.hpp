#pragma once

#include <filesystem>
#include <memory>

#include "catalyst/insitu_abi.h"

namespace breccia {

/// The in-situ adaptor as a library that is opened only when a run asks for it: what it brings along (ParaView, Python)
/// takes some 200 MB a process, which a plain run does not pay.
class InSituPlugin {
 public:
  /// Opens the adaptor. Throws OutputError saying what to install when it is missing, cannot be loaded or is of another
  /// version.
  InSituPlugin();
  [[nodiscard]] const BrecciaInsituApi& api() const { return *api_; }

  /// Where it is looked for: the environment's BRECCIA_CATALYST, or relative to the folder of the program:
  /// ../lib/breccia where both are installed, ../catalyst where they were built.
  [[nodiscard]] static std::filesystem::path place();

 private:
  const BrecciaInsituApi* api_ = nullptr;  // never closed: VTK does not survive being unloaded
};

}  // namespace breccia
