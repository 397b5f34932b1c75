// The functions of insitu_abi.h with ParaView linked.

#include "catalyst/adaptor.hpp"
#include "catalyst/api_functions.hpp"
#include "catalyst/pipeline_choice.hpp"
#include "catalyst/preflight.hpp"
#include "catalyst/replay.hpp"

namespace breccia::insitu {
namespace {

struct ParaViewBackend {
  using Adaptor = insitu::Adaptor;
  static const char* description() { return backend_description(); }
  static std::string found() { return backend_description(); }
  static std::vector<std::string> problems_of(const BrecciaConfig& config) { return insitu::problems_of(config); }
  static std::string replay(const BrecciaConfig& config, const char* folder) {
    for (std::int32_t i = 0; i < config.num_pipelines; ++i) {
      if (!choose(config.pipelines[i]).selection.is_all())
        throw PipelineError(std::string(config.pipelines[i].name) + ": a replay passes all recorded data");
    }
    Adaptor adaptor(config, true);
    const std::string notices = insitu::replay(adaptor, folder);
    return notices + adaptor.finish();
  }
};

}  // namespace
}  // namespace breccia::insitu

extern "C" __attribute__((visibility("default"))) const BrecciaInsituApi* breccia_insitu_api(void) {
  return breccia::insitu::ApiFunctions<breccia::insitu::ParaViewBackend>::api();
}
