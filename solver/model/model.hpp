#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "discretisation/joint_links.hpp"
#include "discretisation/local_mesh.hpp"
#include "mesh/finish.hpp"
#include "mesh/joints.hpp"
#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"
#include "model/plane.hpp"
#include "model/whole_model.hpp"
#include "physics/contact/params.hpp"
#include "physics/elasticity.hpp"
#include "physics/joint_law.hpp"

namespace breccia {

/// A joint of the model: two faces that coincide in the reference mesh.
struct ModelJoint {
  JointFace face;  ///< elements a < b, face of a, code, area, size
  Index law = 0;   ///< index into Model::joint_laws: of its groups, or of its class of strength
};

/// Elements whose corners belong to a physical surface: with a face, or an edge or a point bonded to such a face; to a
/// physical curve or point; or to an element set, with all of them.
struct CornerTag {
  GlobalId element;
  Index group;           ///< as corner_group() counts
  std::uint8_t corners;  ///< a bit a corner
  /// By element, then group.
  [[nodiscard]] bool comes_before(const CornerTag& other) const {
    return element != other.element ? element < other.element : group < other.group;
  }
};

/// Everything that is known before the first step: the case turned into discretised bodies and the small parameter
/// structs of the kernels. Physics never sees the case; this is where it ends. Of the whole model, or of the piece that
/// a rank works on.
struct Model {
  Mesh mesh;
  Topology topology;  ///< faces across which nothing holds (initially broken) are free here
  LocalMesh local;

  std::vector<ElasticParams> elastic;          ///< (volume groups)
  std::vector<double> density;                 ///< (volume groups) kg/m3
  std::vector<Discretisation> discretisation;  ///< (volume groups)
  std::vector<bool> breakable;                 ///< (volume groups) inner faces, or those at an interface, may be freed

  WholeModel whole;
  std::optional<PlaneModel> plane;

  std::vector<JointLawParams> joint_laws;    ///< those of WholeModel::joint_groups, then those of their classes
  std::vector<Index> groups_of_joint_law;    ///< (joint laws) index into WholeModel::joint_groups
  std::vector<std::string> joint_law_names;  ///< (joint groups) "glass", "glass-steel": for reports
  std::vector<std::string> joint_law_keys;   ///< (joint groups) entries of the case: "joint[0]"
  std::vector<double> joint_sizes;           ///< (joint groups) h of k = p/h, m
  std::vector<ModelJoint> joints;            ///< ascending (a, face) and so by id; without those broken from the start
  ContactParams contact;
  std::vector<Topology::Face> contact_faces;  ///< faces that carry points when restricted to surfaces
  bool contact_everywhere = true;
  bool has_contact = false;
  std::vector<CornerTag> corner_tags;  ///< by (element, group)
  std::vector<std::uint8_t> torn;      ///< (mesh elements) a bit a face (torn_faces.hpp)

  MeshReport mesh_report;  ///< of the whole mesh, on the rank that has read it

  /// Id of a joint in the whole model.
  [[nodiscard]] GlobalId joint_id(const JointFace& face) const { return 4 * mesh.element_id(face.a) + face.face_a; }
  [[nodiscard]] GlobalId joint_id(std::size_t joint) const { return joint_id(joints[joint].face); }
};

/// Reads or generates the mesh, checks the case's groups against it and builds the model.
/// Throws InputError with every problem found.
[[nodiscard]] Model build_model(const case_::Case& input);

/// The part of it from which a model is divided among ranks, in a fraction of the memory: mesh, topology, surfaces,
/// materials, laws, contact and what is known of the model as a whole; no joints, nothing discretised. Errors as above.
[[nodiscard]] Model build_bare_model(const case_::Case& input);

/// The model of a piece of the mesh.
/// @param mesh, topology  the piece, faces broken from the start cut;  @param original  (elements) 1: the rank's own
/// @param whole           as build_bare_model found it on the root, with contactor_size
/// @param corner_tags     of the piece's elements, by (element, group);  @param torn  (elements) as Model::torn
[[nodiscard]] Model build_piece(const case_::Case& input, WholeModel whole, Mesh mesh, Topology topology,
                                const std::vector<std::uint8_t>& original, std::vector<CornerTag> corner_tags,
                                std::vector<std::uint8_t> torn);

/// Corners on the surfaces of a mesh: those of their faces, and those connected to them around the same node through
/// faces that no stage breaks; all those at the nodes of its curves and points, and those of its element sets. By
/// (element, group).
/// @param cut  surfaces that stages break. O(elements x surfaces).
[[nodiscard]] std::vector<CornerTag> tag_corners(const std::vector<std::string>& cut, const Mesh& mesh,
                                                 const Topology& topology);

/// Whether a case has laws for a model that is there already. Throws InputError with every joint law that is missing or
/// makes no sense.
void check_laws(const case_::Case& input, const WholeModel& whole);

/// The mesh alone, read or generated; the case may lack all else.
[[nodiscard]] FinishedMesh read_mesh(const case_::Case& input);
/// The same, with the case's groups checked against it, and bodies parted where the case begins with open surfaces.
[[nodiscard]] FinishedMesh build_mesh(const case_::Case& input);

/// Links of the joints that the sweep evaluates.
[[nodiscard]] JointLinks build_links(const Model& model);

/// True if the joint is elastic at first and both its elements own their nodes: evaluated by the sweep until it
/// crosses its limit; else it is on the active list from the start.
[[nodiscard]] bool starts_intact(const Model& model, const ModelJoint& joint);

}  // namespace breccia
