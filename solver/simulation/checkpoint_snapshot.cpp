#include "simulation/checkpoint_snapshot.hpp"

#include <limits>
#include <utility>

#include "domains/corner_tags.hpp"
#include "domains/model_fields.hpp"
#include "domains/piece_mesh.hpp"

namespace breccia {

Snapshot checkpoint_snapshot(const case_::Case& input, const Communicator& communicator, Checkpoint& from) {
  Snapshot snapshot;
  snapshot.whole = unpack_whole(from.whole_model);
  snapshot.weight.assign(from.mine.elements.size(), 1.0);
  snapshot.mine = std::move(from.mine);
  snapshot.state.state = part_of_whole(from.model, communicator.is_root());
  snapshot.state.sample = {energy_of(from.position), from.position.worst_element};
  snapshot.domains = domain_spec(input);
  snapshot.motion = from.position.motion;
  snapshot.stage = static_cast<std::size_t>(from.position.stage);
  return snapshot;
}

Snapshot start_snapshot(const case_::Case& input, const Communicator& communicator, const StartOptions& options,
                        Checkpoint& from) {
  Snapshot snapshot = checkpoint_snapshot(input, communicator, from);
  snapshot.stage = 0;
  snapshot.in_stage = false;
  if (!options.cut.empty()) {
    tag_corners_anew(communicator, snapshot.whole, options.cut, snapshot.mine);
    snapshot.whole.cut = options.cut;
  }
  if (!options.new_laws) return snapshot;
  snapshot.whole.step_ratio = 0;
  snapshot.state.state.work.first_excess = std::numeric_limits<double>::quiet_NaN();
  return snapshot;
}

}  // namespace breccia
