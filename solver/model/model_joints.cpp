#include "model/model_joints.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "base/number_text.hpp"
#include "case/joint_entries.hpp"
#include "case/problem_at.hpp"
#include "model/node_sets.hpp"
#include "model/parameters.hpp"
#include "model/strength_scatter.hpp"

namespace breccia {
namespace {

GroupPair groups_of(const Model& model, const JointFace& face) {
  return std::minmax(model.mesh.element_group[at(face.a)], model.mesh.element_group[at(face.b)]);
}

bool has_joint(const Model& model, const GroupPair& groups) {
  return !share_nodes(model.discretisation, model.whole.node_sets, groups.first, groups.second);
}

/// The law that the case has for a pair of groups.
case_::Joint law_of(const case_::Case& input, const std::vector<std::string>& names, const GroupPair& groups) {
  const std::string &first = names[at(groups.first)], &second = names[at(groups.second)];
  const case_::Joint* entry = case_::joint_entry(input, first, second).ruling;
  DEMAND(entry != nullptr, first + " and " + second + " have no joint law");
  return case_::joint_between(input, *entry, first, second);
}

/// Joints can fail inside of a breakable group, and at any interface that has a strength.
bool can_fail(const case_::Case& input, const case_::Joint& entry) {
  if (!entry.inside()) return entry.tensile_strength > 0;
  return material_in(input, entry.groups[0]).joints == case_::JointPlacement::breakable;
}

void include_class(WholeModel::JointGroups& groups, Index number) {
  const Index end = groups.num_classes > 0 ? std::max(groups.least_class + groups.num_classes, number + 1) : number + 1;
  groups.least_class = groups.num_classes > 0 ? std::min(groups.least_class, number) : number;
  groups.num_classes = end - groups.least_class;
}

void add_law(const case_::Case& input, const case_::Joint& entry, double size, Model& model,
             std::vector<Problem>& problems, const std::string& whose = "") {
  JointLawParams params = joint_law_params(entry, size, !can_fail(input, entry));
  if (const std::string problem = prepare(params); !problem.empty())
    problems.push_back(case_::problem_at(input, entry.origin, "", whose + problem, "", ""));
  model.joint_laws.push_back(params);
}

/// The laws of all classes of strength. @param entries  of the joint groups
void add_class_laws(const case_::Case& input, const std::vector<case_::Joint>& entries, Model& model,
                    std::vector<Problem>& problems) {
  for (std::size_t g = 0; g < entries.size(); ++g) {
    const WholeModel::JointGroups& groups = model.whole.joint_groups[g];
    const std::size_t known = problems.size();
    for (Index c = 0; c < groups.num_classes && problems.size() == known; ++c) {
      const double factor = strength_factor(groups.least_class + c);
      case_::Joint entry = entries[g];
      entry.tensile_strength *= factor;
      entry.shear_strength *= factor;
      add_law(input, entry, model.joint_sizes[g], model, problems,
              "of a joint of " + number_text(factor, 3) + " times the mean strength (weibull_modulus): ");
      model.groups_of_joint_law.push_back(static_cast<Index>(g));
    }
  }
}

}  // namespace

std::optional<Problem> wrong_joint_law(const case_::Case& input, const std::vector<std::string>& names,
                                       const WholeModel::JointGroups& groups) {
  const std::string &first = names[at(groups.a)], &second = names[at(groups.b)];
  const std::string pair = "\"" + first + "\" and \"" + second + "\"";
  const std::string own = "a [[joint]] with between = [\"" + first + "\", \"" + second + "\"]";
  const auto [entry, tied] = case_::joint_entry(input, first, second);
  if (entry == nullptr) {
    return Problem{input.file.string(),
                   input.mesh.origin.line,
                   "joint",
                   "the meshes of " + pair + " are glued, but there is no joint law between them",
                   own + ", or mesh.glue = false",
                   ""};
  }
  if (tied == nullptr) return std::nullopt;
  return case_::problem_at(input, tied->origin, "between",
                           "this entry and " + entry->origin.key + " (line " + std::to_string(entry->origin.line) +
                               ") fit the interface of " + pair + " alike",
                           own, "");
}

void find_joint_groups(const case_::Case& input, Model& model) {
  const std::vector<std::string>& names = model.mesh.volume_groups;
  WholeModel& whole = model.whole;
  std::map<GroupPair, std::size_t> known;  // to the place in joint_groups
  std::vector<std::optional<case_::Joint>> entries;
  std::vector<double> count;
  std::vector<Problem> problems;
  for_each_joint_face(model.mesh, model.topology, [&](const JointFace& face) {
    const GroupPair groups = groups_of(model, face);
    if (!has_joint(model, groups)) return;
    const auto [place, fresh] = known.emplace(groups, whole.joint_groups.size());
    if (fresh) {
      whole.joint_groups.push_back({groups.first, groups.second, 0.0});
      count.push_back(0.0);
      entries.emplace_back();
      if (auto problem = wrong_joint_law(input, names, whole.joint_groups.back()))
        problems.push_back(std::move(*problem));
      else
        entries.back() = law_of(input, names, groups);
    }
    const std::size_t g = place->second;
    whole.joint_groups[g].size += face.size;
    if (entries[g] && entries[g]->weibull_modulus > 0)
      include_class(whole.joint_groups[g], strength_class(*entries[g], model.joint_id(face), face.area));
    count[g] += 1.0;
    ++whole.num_joints;
  });
  if (!problems.empty()) throw InputError(std::move(problems));
  for (std::size_t l = 0; l < count.size(); ++l) whole.joint_groups[l].size /= count[l];
}

void take_joint_laws(const case_::Case& input, Model& model) {
  const std::vector<std::string>& names = model.mesh.volume_groups;
  std::vector<Problem> problems;
  std::vector<case_::Joint> entries;
  for (const WholeModel::JointGroups& groups : model.whole.joint_groups) {
    entries.push_back(law_of(input, names, {groups.a, groups.b}));
    const case_::Joint& entry = entries.back();
    const std::string &first = names[at(groups.a)], &second = names[at(groups.b)];
    model.joint_law_names.push_back(first == second ? first : first + "-" + second);
    model.joint_law_keys.push_back(entry.origin.key);
    model.joint_sizes.push_back(entry.size > 0 ? entry.size : groups.size);
    add_law(input, entry, model.joint_sizes.back(), model, problems);
    model.groups_of_joint_law.push_back(static_cast<Index>(entries.size() - 1));
    if (!entry.inside() && entry.tensile_strength > 0)
      model.breakable[at(groups.a)] = model.breakable[at(groups.b)] = true;
  }
  if (problems.empty()) add_class_laws(input, entries, model, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
}

void take_joints(const case_::Case& input, Model& model) {
  struct PairLaw {
    Index reference, first_of_class;  ///< laws
    const WholeModel::JointGroups& groups;
    case_::Joint entry;
  };
  std::map<GroupPair, PairLaw> laws;
  for (std::size_t g = 0; g < model.whole.joint_groups.size(); ++g) {
    const WholeModel::JointGroups& groups = model.whole.joint_groups[g];
    const GroupPair pair{groups.a, groups.b};
    laws.emplace(pair, PairLaw{static_cast<Index>(g), static_cast<Index>(model.whole.first_class_law(g)), groups,
                               law_of(input, model.mesh.volume_groups, pair)});
  }
  const auto law_for = [&](const PairLaw& law, const JointFace& face) {
    if (law.groups.num_classes == 0) return law.reference;
    const Index place = strength_class(law.entry, model.joint_id(face), face.area) - law.groups.least_class;
    DEMAND(0 <= place && place < law.groups.num_classes, "a joint of no class of strength");
    return law.first_of_class + place;
  };
  model.joints.reserve(2 * model.mesh.elements.size());
  for_each_joint_face(model.mesh, model.topology, [&](const JointFace& face) {
    const GroupPair groups = groups_of(model, face);
    if (has_joint(model, groups)) model.joints.push_back({face, law_for(laws.at(groups), face)});
  });
}

}  // namespace breccia
