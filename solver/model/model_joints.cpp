#include "model/model_joints.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "model/parameters.hpp"

namespace breccia {
namespace {

using Pair = std::pair<Index, Index>;  ///< of groups, a <= b

std::size_t index(Index i) { return static_cast<std::size_t>(i); }

Pair groups_of(const Model& model, const JointFace& face) {
  return std::minmax(model.mesh.element_group[index(face.a)], model.mesh.element_group[index(face.b)]);
}

bool has_joint(const Model& model, const Pair& groups) {
  return model.discretisation[index(groups.first)] == Discretisation::own_nodes ||
         model.discretisation[index(groups.second)] == Discretisation::own_nodes;
}

/// The case's entry for a pair of groups, null: none.
const case_::Joint* entry_for(const case_::Case& input, const std::vector<std::string>& names, const Pair& groups) {
  const std::string &first = names[index(groups.first)], &second = names[index(groups.second)];
  for (const case_::Joint& joint : input.joints) {
    if ((joint.groups[0] == first && joint.groups[1] == second) ||
        (joint.groups[0] == second && joint.groups[1] == first))
      return &joint;
  }
  return nullptr;
}

Problem no_law(const case_::Case& input, const std::vector<std::string>& names, const Pair& groups) {
  const std::string &first = names[index(groups.first)], &second = names[index(groups.second)];
  return {input.file.string(),
          input.mesh.origin.line,
          "joint",
          "the meshes of \"" + first + "\" and \"" + second + "\" are glued, but no joint law says how",
          "a [[joint]] with between = [\"" + first + "\", \"" + second + "\"], or mesh.glue = false",
          ""};
}

/// Joints can fail inside of a breakable group and where one ends, and at any interface that has a strength.
bool can_fail(const case_::Case& input, const case_::Joint& entry) {
  const auto breakable = [&](const case_::Material& m) {
    return m.joints == case_::JointPlacement::breakable && (m.group == entry.groups[0] || m.group == entry.groups[1]);
  };
  return std::any_of(input.materials.begin(), input.materials.end(), breakable) ||
         (entry.groups[0] != entry.groups[1] && entry.tensile_strength > 0);
}

}  // namespace

std::optional<Problem> missing_joint_law(const case_::Case& input, const std::vector<std::string>& names,
                                         const WholeModel::JointGroups& groups) {
  const Pair pair{groups.a, groups.b};
  if (entry_for(input, names, pair) != nullptr) return std::nullopt;
  return no_law(input, names, pair);
}

void find_joint_groups(const case_::Case& input, Model& model) {
  const std::vector<std::string>& names = model.mesh.volume_groups;
  WholeModel& whole = model.whole;
  std::map<Pair, std::size_t> known;  // to the place in joint_groups
  std::vector<double> count;
  std::vector<Problem> problems;
  for_each_joint_face(model.mesh, model.topology, [&](const JointFace& face) {
    const Pair groups = groups_of(model, face);
    if (!has_joint(model, groups)) return;
    const auto [place, fresh] = known.emplace(groups, whole.joint_groups.size());
    if (fresh) {
      whole.joint_groups.push_back({groups.first, groups.second, 0.0});
      count.push_back(0.0);
      if (entry_for(input, names, groups) == nullptr) problems.push_back(no_law(input, names, groups));
    }
    whole.joint_groups[place->second].size += face.size;
    count[place->second] += 1.0;
    ++whole.num_joints;
  });
  if (!problems.empty()) throw InputError(std::move(problems));
  for (std::size_t l = 0; l < count.size(); ++l) whole.joint_groups[l].size /= count[l];
}

void take_joint_laws(const case_::Case& input, Model& model) {
  const std::vector<std::string>& names = model.mesh.volume_groups;
  std::vector<Problem> problems;
  for (const WholeModel::JointGroups& groups : model.whole.joint_groups) {
    const case_::Joint* entry = entry_for(input, names, {groups.a, groups.b});
    DEMAND(entry != nullptr, names[index(groups.a)] + " and " + names[index(groups.b)] + " have no joint law");
    const bool unbreakable = !can_fail(input, *entry);
    model.joint_sizes.push_back(entry->size > 0 ? entry->size : groups.size);
    JointLawParams params = joint_law_params(*entry, model.joint_sizes.back(), unbreakable);
    if (const std::string problem = prepare(params); !problem.empty())
      problems.push_back({input.file.string(), entry->origin.line, entry->origin.key, problem, "", ""});
    model.joint_laws.push_back(std::move(params));
    const std::string &first = names[index(groups.a)], &second = names[index(groups.b)];
    model.joint_law_names.push_back(first == second ? first : first + "-" + second);
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

void take_joints(Model& model) {
  std::map<Pair, Index> law_of;
  for (const WholeModel::JointGroups& groups : model.whole.joint_groups)
    law_of.emplace(Pair{groups.a, groups.b}, static_cast<Index>(law_of.size()));
  model.joints.reserve(2 * model.mesh.elements.size());
  for_each_joint_face(model.mesh, model.topology, [&](const JointFace& face) {
    const Pair groups = groups_of(model, face);
    if (has_joint(model, groups)) model.joints.push_back({face, law_of.at(groups)});
  });
}

}  // namespace breccia
