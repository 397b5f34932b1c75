#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/parent_case.hpp"
#include "model/constraint_conflicts.hpp"
#include "output/checkpoint/checkpoint.hpp"
#include "output/folder/run_folder.hpp"
#include "parallel/communicator.hpp"
#include "simulation/run.hpp"

namespace breccia {

/// The state from which a case with [start] begins.
struct StartState {
  std::filesystem::path file;  ///< the checkpoint
  Checkpoint checkpoint;
  case_::ParentCase parent;
};

/// Finds, reads and verifies what [start] names; nullopt: the case starts at rest. No other checkpoint than the
/// requested one is used. Collective. Throws InputError on all ranks: no such run, none of that time or step, damaged
/// or foreign files.
[[nodiscard]] std::optional<StartState> read_start_state(const std::filesystem::path& case_file,
                                                         const std::vector<std::string>& overrides,
                                                         const Communicator& world);

/// The case, read against the state. Throws InputError: as read_case; what it changes that the state fixes; stages that
/// have ended before; groups and joint laws that do not fit the elements of the state.
[[nodiscard]] case_::Case read_case_of(const std::filesystem::path& case_file,
                                       const std::vector<std::string>& overrides,
                                       const std::optional<StartState>& start);

/// Constraints with different motions for the same nodes of the state, as constraint_conflicts. Collective.
[[nodiscard]] std::vector<ConstraintConflict> conflicts_of(const case_::Case& input, const StartState& start,
                                                           const Communicator& world);

/// For start_case.
[[nodiscard]] StartOptions start_options(const case_::Case& input, const StartState& start);

/// Throws InputError if the results would be written where the state is.
void refuse_folder_of_state(const std::filesystem::path& results, const StartState& start);

/// What a run that starts from a checkpoint was made from: its case, and what the state was made from, with the hashes
/// of that time, since no mesh is read; the content of a mesh that it names is that of the state's.
[[nodiscard]] std::vector<Provenance::Input> inputs_of_started(const std::filesystem::path& case_file,
                                                               const case_::Case& input, const Checkpoint& checkpoint);

/// The parents of a run that starts from a checkpoint: its run and the parents of that.
[[nodiscard]] std::vector<Provenance::Parent> with_parent(const std::filesystem::path& file,
                                                          const Checkpoint& checkpoint);

/// The root's files, on all ranks: a run in progress writes and removes checkpoints, so that ranks that search
/// separately might choose differently. Collective.
void of_root(std::vector<std::filesystem::path>& files, const Communicator& world);

/// Whose state it is: "the state of step 1200 at 2.4 s of FILE".
[[nodiscard]] std::string words_of(const StartState& start);

}  // namespace breccia
