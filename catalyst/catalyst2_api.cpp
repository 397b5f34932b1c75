// The functions of insitu_abi.h over Catalyst 2.

#include "catalyst/api_functions.hpp"
#include "catalyst/catalyst2_adaptor.hpp"
#include "catalyst/catalyst2_preflight.hpp"

namespace breccia::insitu {
namespace {

struct Catalyst2Backend {
  using Adaptor = Catalyst2Adaptor;
  static const char* description() { return "Catalyst 2"; }
  static std::string found() { return found_catalyst2(); }
  static std::vector<std::string> problems_of(const BrecciaConfig& config) { return catalyst2_problems_of(config); }
  static std::string replay(const BrecciaConfig&, const char*) {
    throw PipelineError("recordings are read by the adaptor with ParaView linked alone");
  }
};

}  // namespace
}  // namespace breccia::insitu

extern "C" __attribute__((visibility("default"))) const BrecciaInsituApi* breccia_insitu_api(void) {
  return breccia::insitu::ApiFunctions<breccia::insitu::Catalyst2Backend>::api();
}
