#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "model/stage_loads.hpp"
#include "physics/contact/params.hpp"
#include "physics/elasticity.hpp"
#include "physics/initial_velocity.hpp"
#include "physics/joint_law.hpp"

namespace breccia {

/// Case entries turned into the parameter structs of the kernels: the border that the case does not cross.

/// The material of a volume group. @pre it has one (case_::check_groups)
[[nodiscard]] const case_::Material& material_in(const case_::Case& input, const std::string& group);

[[nodiscard]] ElasticParams elastic_params(const case_::Material& material);

/// @param size         h of k = p/h, m
/// @param unbreakable  strengths become infinite
[[nodiscard]] JointLawParams joint_law_params(const case_::Joint& joint, double size, bool unbreakable);

/// The entry of the case that holds for a pair, null: none. "*" fits every group; of several that fit the one that
/// names more of the groups wins, of these the later one.
[[nodiscard]] const case_::Contact* contact_entry(const case_::Case& input, const std::string& group,
                                                  const std::string& other);

/// That entry, and the last one before it that names as many of the groups; null: none.
struct TiedContacts {
  const case_::Contact* ruling = nullptr;
  const case_::Contact* overruled = nullptr;
};
[[nodiscard]] TiedContacts tied_contact_entries(const case_::Case& input, const std::string& group,
                                                const std::string& other);

[[nodiscard]] ContactParams contact_params(const case_::Case& input, const std::vector<std::string>& groups);

struct Model;
/// @param groups  names of the volume groups, each with a [[material]]
[[nodiscard]] std::vector<Discretisation> discretisations(const case_::Case& input,
                                                          const std::vector<std::string>& groups);

/// In the order of the case; they add up.
/// (slots) 1: an element of this set; empty: the mesh has no element set of the name.
[[nodiscard]] std::vector<std::uint8_t> slots_of_set(const Model& model, const std::string& name);
[[nodiscard]] std::vector<InitialVelocity> initial_velocities(const case_::Case& input, const Model& model);
[[nodiscard]] StageLoads stage_loads(const case_::Stage& stage, const Model& model);

/// Nodes of a volume, surface, curve or point group, ascending. A surface means the corners of its faces, and those of
/// elements that touch it with an edge or a corner and are connected to such a face around the node: not what lies
/// across a notch that begins at the surface's border.
[[nodiscard]] std::vector<Index> nodes_of_group(const Model& model, const std::string& group);

/// Of these, the ones that this rank counts.
[[nodiscard]] std::vector<Index> counted_nodes_of_group(const Model& model, const std::string& group);

/// Faces of a surface group as the loads want them.
[[nodiscard]] std::vector<LoadedFace> faces_of_surface(const Model& model, const std::string& surface);

}  // namespace breccia
