#pragma once

#include <array>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "mesh/finish.hpp"
#include "mesh/joints.hpp"
#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"
#include "physics/contact/contact_params.hpp"
#include "physics/elasticity.hpp"
#include "physics/joint_law.hpp"
#include "state/joint_links.hpp"
#include "state/local_mesh.hpp"

namespace breccia {

/// A joint of the model: two faces that coincide in the reference mesh.
struct ModelJoint {
  JointFace face;   ///< elements a < b, face of a, code, area, size
  Index law = 0;    ///< index into Model::joint_laws
};

/// Everything that is known before the first step: the case turned into discretised bodies and the small parameter structs
/// of the kernels. Physics never sees the case; this is where it ends.
struct Model {
  Mesh mesh;
  Topology topology;   ///< faces across which nothing holds (initially broken) are free here
  LocalMesh local;

  std::vector<ElasticParams> elastic;         ///< (volume groups)
  std::vector<double> density;                ///< (volume groups) kg/m3
  std::vector<Discretisation> discretisation; ///< (volume groups)
  std::vector<bool> breakable;                ///< (volume groups)

  std::vector<JointLawParams> joint_laws;
  std::vector<std::string> joint_law_names;   ///< "glass", "glass-steel": for reports
  std::vector<double> joint_sizes;            ///< h of k = p/h by law, m
  std::vector<ModelJoint> joints;             ///< ascending (a, face): index = joint id; without those broken from the start
  ContactParams contact;
  std::vector<Topology::Face> contact_faces;  ///< faces that carry points when restricted to surfaces
  bool contact_everywhere = true;
  bool has_contact = false;

  MeshReport mesh_report;
};

/// Reads or generates the mesh, checks the case's groups against it and builds the model.
/// Throws InputError with every problem found.
[[nodiscard]] Model build_model(const case_::Case& input);

/// The mesh alone, read or generated, with the case's groups checked against it.
[[nodiscard]] FinishedMesh build_mesh(const case_::Case& input);

/// Links of the joints that the sweep looks after.
[[nodiscard]] JointLinks build_links(const Model& model);

/// True if the joint is elastic at first and both its elements own their nodes: the sweep's business until it crosses its
/// limit; else it is on the active list from the start.
[[nodiscard]] bool starts_intact(const Model& model, const ModelJoint& joint);

}  // namespace breccia
