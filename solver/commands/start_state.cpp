#include "commands/start_state.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <system_error>

#include "base/error.hpp"
#include "base/quantity_text.hpp"
#include "case/problem_at.hpp"
#include "case/reader.hpp"
#include "case/validate.hpp"
#include "case/validate_motion.hpp"
#include "domains/piece_mesh.hpp"
#include "domains/possible_records.hpp"
#include "model/node_sets.hpp"
#include "model/parameters.hpp"
#include "model/surfaces_to_break.hpp"
#include "output/checkpoint/checkpoint_index.hpp"
#include "output/folder/folder_check.hpp"
#include "output/folder/resumed_folder.hpp"
#include "output/folder/run_lock.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// Checkpoints that a message names at most.
constexpr std::size_t kNamed = 8;

[[noreturn]] void refuse(const fs::path& case_file, const case_::Start& start, const std::string& key,
                         const std::string& what, const std::string& allowed, const std::string& given) {
  throw InputError(case_::problem_at(case_file, start.origin, key, what, allowed, given));
}

struct Choice {
  fs::path file;
  std::int64_t step = 0;
  double time = 0;  ///< s
};

/// @param unreadable  receives the names of those that cannot be read
std::vector<Choice> choices_in(const fs::path& folder, std::string& unreadable) {
  std::vector<Choice> choices;
  for (const CheckpointEntry& entry : checkpoints_in(folder)) {
    try {
      const CheckpointIndex index = read_index(entry.file);
      choices.push_back({entry.file, index.step, index.time});
    } catch (const InputError&) {
      unreadable += (unreadable.empty() ? "" : ", ") + entry.file.filename().string();
    }
  }
  return choices;
}

std::string words_of(const std::vector<Choice>& choices) {
  std::string words;
  for (std::size_t i = 0; i < std::min(choices.size(), kNamed); ++i)
    words += fmt::format("{}step {} at {}", i == 0 ? "" : ", ", choices[i].step, quantity_text(choices[i].time, "s"));
  return words;
}

/// The checkpoint of the requested time or step, from a folder.
fs::path chosen(const fs::path& case_file, const case_::Start& start, const fs::path& folder) {
  for (const CheckpointEntry& entry : checkpoints_in(folder)) {
    if (start.step > 0 && entry.step == start.step) return entry.file;
  }
  std::string unreadable;
  const std::vector<Choice> choices = choices_in(folder, unreadable);
  const auto off = [&](const Choice& choice) { return std::abs(choice.time - start.at); };
  const auto nearest = std::min_element(choices.begin(), choices.end(),
                                        [&](const Choice& a, const Choice& b) { return off(a) < off(b); });
  // A checkpoint at an interval is that of the step next to it.
  const auto is_close = [&](const Choice& choice) {
    return off(choice) <= 1.01 * choice.time / static_cast<double>(std::max<std::int64_t>(1, choice.step));
  };
  if (start.step == 0 && nearest != choices.end() && is_close(*nearest)) return nearest->file;
  const std::string given = start.step > 0 ? std::to_string(start.step) : quantity_text(start.at, "s");
  refuse(case_file, start, start.step > 0 ? "step" : "at",
         "the run has no such checkpoint" + (unreadable.empty() ? "" : "; these cannot be read: " + unreadable),
         choices.empty() ? "none can be read" : words_of(choices), given);
}

/// The folder above one, however that is written.
fs::path run_of(const fs::path& checkpoints) {
  std::error_code error;
  const fs::path whole = fs::absolute(checkpoints, error).lexically_normal();
  return whole.has_filename() ? whole.parent_path() : whole.parent_path().parent_path();
}

fs::path checkpoint_of(const fs::path& case_file, const case_::Start& start) {
  std::error_code error;
  if (!fs::exists(start.from, error))
    refuse(case_file, start, "from", "there is no such run", "the folder of a run, or one of its checkpoints",
           start.from.string());
  if (!fs::is_directory(start.from, error)) {
    if (start.step > 0 || start.at > 0)
      refuse(case_file, start, start.step > 0 ? "step" : "at", "belongs to the folder of a run",
             "no at and no step beside a checkpoint", start.from.string());
    return start.from;
  }
  demand_plain_folder(RunFolder{start.from});
  const fs::path folder = RunFolder{start.from}.checkpoints();
  const std::vector<CheckpointEntry> all = checkpoints_in(folder);
  if (all.empty() && !checkpoints_in(start.from).empty())
    refuse(case_file, start, "from", "this is the folder of a run's checkpoints, not of the run",
           run_of(start.from).string() + ", or " + checkpoints_in(start.from).front().file.string(),
           start.from.string());
  if (all.empty())
    refuse(case_file, start, "from", "there are no checkpoints of a run here",
           "the folder of a run with checkpoints/step_*.h5, or one of these files", start.from.string());
  if (start.step > 0 || start.at > 0) return chosen(case_file, start, folder);
  if (const std::string holder = holder_of(start.from); !holder.empty())
    refuse(case_file, start, "from", "this run is in progress and has no last state yet: " + holder,
           "start.at, start.step or one of its checkpoints, or this folder when that run has ended",
           start.from.string());
  return all.front().file;
}

/// What reading the checkpoint finds wrong belongs to the case that names it.
[[noreturn]] void refuse_start(const fs::path& case_file, const case_::Start& start, const InputError& error) {
  std::vector<Problem> problems;
  for (const Problem& p : error.problems())
    problems.push_back(case_::problem_at(case_file, start.origin, "from", p.what, p.allowed, p.file));
  throw InputError(std::move(problems));
}

case_::ParentCase parent_of(const Checkpoint& checkpoint, const fs::path& file) {
  std::map<std::string, std::string> files;
  for (const Provenance::Input& input : inputs_in(checkpoint.provenance)) files[input.file] = input.sha256;
  return case_::parent_case(checkpoint.case_text, file, std::move(files),
                            unpack_whole(checkpoint.whole_model).volume_groups);
}

/// Those of this rank's elements.
std::vector<NamedNode> nodes_of_records(const Records& records, const WholeModel& whole,
                                        const std::vector<Discretisation>& kinds, const std::string& group) {
  std::vector<NamedNode> nodes;
  const auto add = [&](const ElementRecord& element, unsigned corners) {
    const Index set = node_set(kinds, whole.node_sets, element.group);
    for (int c = 0; c < 4; ++c) {
      if ((corners >> c & 1U) != 0)
        nodes.push_back(named_node(set, element.id, c, element.vertex[static_cast<std::size_t>(c)]));
    }
  };
  const Index volume = group_index(whole.volume_groups, group), of_corners = corner_group(whole, group);
  for (const ElementRecord& element : records.elements) {
    if (element.group == volume) add(element, 15);
  }
  for (const CornerTag& tag : records.corners) {
    const Index place = volume < 0 && tag.group == of_corners ? records.place_of(tag.element) : -1;
    if (place >= 0) add(records.elements[static_cast<std::size_t>(place)], static_cast<unsigned>(tag.corners));
  }
  return nodes;
}

/// Stages count from the start of the first run.
void check_stages(const case_::Case& input, const Clock& clock) {
  const case_::Stage& first = input.stages.front();
  if (first.end > clock.time + 0.5 * clock.dt) {
    std::vector<Problem> jumps = case_::jumps_at(input, first, clock.time);
    if (!jumps.empty()) throw InputError(std::move(jumps));
    return;
  }
  throw InputError(
      case_::problem_at(input, first.origin, "end",
                        "the state that the run starts from is later than the end of this stage: time is counted from "
                        "that run",
                        "later than " + quantity_text(clock.time, "s"), quantity_text(first.end, "s")));
}

}  // namespace

void of_root(std::vector<fs::path>& files, const Communicator& world) {
  std::string names;
  for (const fs::path& file : files) names += file.native() + '\0';
  const auto raw = std::as_bytes(std::span(names));
  std::vector<std::byte> bytes(raw.begin(), raw.end());
  world.broadcast(bytes);
  names.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  files.clear();
  for (std::size_t at = 0; at < names.size(); at = names.find('\0', at) + 1) files.emplace_back(names.c_str() + at);
}

std::optional<StartState> read_start_state(const fs::path& case_file, const std::vector<std::string>& overrides,
                                           const Communicator& world) {
  std::optional<case_::Start> start;
  StartState state;
  world.agree([&] {
    start = case_::read_start(case_file, overrides);
    if (start && world.is_root()) state.file = checkpoint_of(case_file, *start);
  });
  if (!start) return std::nullopt;
  std::vector<fs::path> chosen{state.file};
  of_root(chosen, world);
  state.file = chosen.front();
  try {
    state.checkpoint = read_checkpoint(state.file, world);
    world.agree([&] { demand_possible(state.file, state.checkpoint.whole_model, state.checkpoint.mine); });
  } catch (const InputError& error) {  // the same on all ranks
    refuse_start(case_file, *start, error);
  }
  world.agree([&] {
    std::error_code error;
    if (world.is_root() && fs::is_directory(start->from, error))
      demand_own_run(RunFolder{start->from}, state.file, state.checkpoint);
  });
  world.agree([&] { state.parent = parent_of(state.checkpoint, state.file); });
  return state;
}

case_::Case read_case_of(const fs::path& case_file, const std::vector<std::string>& overrides,
                         const std::optional<StartState>& start) {
  if (!start) return case_::read_case(case_file, overrides);
  case_::Case input = case_::read_started_case(case_file, overrides, start->parent);
  check_stages(input, start->checkpoint.model.clock);
  const WholeModel whole = unpack_whole(start->checkpoint.whole_model);
  std::vector<Problem> problems =
      case_::check_groups(input, {whole.volume_groups, whole.surface_groups, whole.node_groups, whole.element_sets},
                          static_cast<std::int64_t>(whole.body_length.size()));
  if (!problems.empty()) throw InputError(std::move(problems));
  check_laws(input, whole);
  return input;
}

std::vector<ConstraintConflict> conflicts_of(const case_::Case& input, const StartState& start,
                                             const Communicator& world) {
  const WholeModel whole = unpack_whole(start.checkpoint.whole_model);
  const std::vector<Discretisation> kinds = discretisations(input, whole.volume_groups);
  NodesOfGroups nodes;
  for (const std::string& group : groups_to_compare(input)) {
    const std::vector<NamedNode> mine = nodes_of_records(start.checkpoint.mine, whole, kinds, group);
    for (const auto& of_rank : world.all_gather(std::span(mine)))
      nodes[group].insert(nodes[group].end(), of_rank.begin(), of_rank.end());
    sort_nodes(nodes[group]);
  }
  return constraint_conflicts(input, nodes);
}

StartOptions start_options(const case_::Case& input, const StartState& start) {
  StartOptions options{"the run starts from " + words_of(start), case_::laws_differ(start.parent.input, input), {}};
  if (options.new_laws)
    options.words +=
        "; under other laws than there, so the energy that it holds counts as put in, and the residual "
        "from here";
  const std::vector<std::string> before = unpack_whole(start.checkpoint.whole_model).cut,
                                 now = surfaces_to_break(input);
  std::set<std::string> all(before.begin(), before.end());
  all.insert(now.begin(), now.end());
  if (all.size() > before.size()) options.cut.assign(all.begin(), all.end());
  return options;
}

void refuse_folder_of_state(const fs::path& results, const StartState& start) {
  std::error_code error;
  const fs::path run = fs::absolute(start.file, error).parent_path().parent_path();
  if (!fs::equivalent(results, run, error) || error) return;
  throw OutputError(Problem{results.string(), 0, "", "this folder holds the state that the run starts from",
                            "another folder (-o)", ""});
}

std::vector<Provenance::Input> inputs_of_started(const fs::path& case_file, const case_::Case& input,
                                                 const Checkpoint& checkpoint) {
  std::vector<Provenance::Input> inputs{input_file(case_file)};
  const auto add = [&](const Provenance::Input& added) {
    const auto is_it = [&](const Provenance::Input& known) { return known.file == added.file; };
    if (std::none_of(inputs.begin(), inputs.end(), is_it)) inputs.push_back(added);
  };
  for (const Provenance::Input& before : inputs_in(checkpoint.provenance)) add(before);
  if (!input.mesh.file.empty()) add(input_file(input.mesh.file));
  for (const case_::DataFiles::One& one : input.data.files) add(input_file(one.file));
  return inputs;
}

std::vector<Provenance::Parent> with_parent(const fs::path& file, const Checkpoint& checkpoint) {
  const Clock& clock = checkpoint.model.clock;
  std::error_code error;
  const Provenance::Input hashed = input_file(fs::absolute(file, error).lexically_normal());
  std::vector<Provenance::Parent> parents{{hashed.file, hashed.sha256, clock.steps, clock.time}};
  const std::vector<Provenance::Parent> earlier = parents_in(checkpoint.provenance);
  parents.insert(parents.end(), earlier.begin(), earlier.end());
  return parents;
}

std::string words_of(const StartState& start) {
  const Clock& clock = start.checkpoint.model.clock;
  return fmt::format("step {} at {} of {}", clock.steps, quantity_text(clock.time, "s"), start.file.string());
}

}  // namespace breccia
