#pragma once

#include <algorithm>
#include <limits>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "contact/contact_search.hpp"
#include "physics/contact/forces.hpp"
#include "unit/physics/contact/scene.hpp"

/// Boxes that may break, with their contact, for the tests of contact/.
namespace breccia::test {

inline const ContactLaw kLaw{1e6, std::numeric_limits<double>::infinity(), 1, 0, 1};

struct WithContactState {
  ContactState state;
};

/// The contact of a rank that is alone, with its state.
class OwnedContact : WithContactState, public ContactSearch {
 public:
  OwnedContact(const ContactSearchParams& search, const ContactModel& model)
      : ContactSearch(search, model, state), model_(model) {}

  /// A step of length dt, s, in which no node was faster than max_speed, m/s.
  void update(const NodalState& nodes, double max_speed, double dt) {
    count_travel(max_speed * dt);
    if (due(nodes, {max_speed * dt}, {})) {
      search(nodes, max_speed * dt);
      ++num_searches_;
    }
    verify(nodes);
  }
  void forces(const NodalState& nodes, double dt, NodalForces& forces, ContactWork& work) {
    contact_forces(model_.params, model_.local, nodes, dt, state, forces, work);
  }
  /// As if nothing were known of how far nodes have moved, from the next call of forces() on.
  void look_at_all() { state.travel = std::numeric_limits<double>::infinity(); }
  [[nodiscard]] int num_searches() const { return num_searches_; }
  [[nodiscard]] double buffer() const { return searches().buffer(); }

 private:
  ContactModel model_;
  int num_searches_ = 0;
};

/// Boxes of breakable or unbreakable elements with a search over them.
struct BreakingBoxes {
  Mesh mesh;
  Topology topology;
  LocalMesh local;
  ContactParams params;
  ContactSearchParams search;
  NodalState state;

  explicit BreakingBoxes(Mesh m, bool breakable = true, int points = 3)
      : mesh(std::move(m)), topology(build_topology(mesh)) {
    const std::size_t groups = mesh.volume_groups.size();
    local = build_local_mesh(mesh, std::vector(groups, Discretisation::own_nodes), std::vector(groups, 1000.0));
    params.points_per_face = points;
    params.num_groups = static_cast<Index>(groups);
    params.laws.assign(groups * groups, kLaw);
    search.breakable.assign(groups, breakable);
    state.position = local.reference;
    state.velocity.assign(local.reference.size(), 0.0);
  }
  [[nodiscard]] OwnedContact make() const { return {search, {params, mesh, topology, local}}; }

  void shake(std::mt19937_64& random, double by) {
    std::uniform_real_distribution<double> jitter(-by, by);
    for (double& x : state.position) x += jitter(random);
  }
  void shift(Index body, const Vec3& by) {
    for (Index s = 0; s < local.num_slots; ++s) {
      for (int c = 0; c < 4 && local.slot_body[at(s)] == body; ++c) {
        const Index n = local.corner_node(s, c);
        store_node(state.position.data(), n, load_node(state.position.data(), n) + by);
      }
    }
  }
  /// A share of the inner faces, one side each.
  [[nodiscard]] std::vector<FreedFace> some_faces(std::mt19937_64& random, double share) const {
    std::vector<FreedFace> faces;
    std::bernoulli_distribution chosen(share);
    for (Index e = 0; e < mesh.num_elements(); ++e) {
      for (int f = 0; f < 4; ++f) {
        const FaceLink& link = topology.links[at(e)][at(f)];
        if (!link.free() && e < link.neighbour && chosen(random)) faces.push_back({local.slot_of_element[at(e)], f});
      }
    }
    std::shuffle(faces.begin(), faces.end(), random);
    return faces;
  }
};

/// Point id and contactor of a couple.
using Pair = std::pair<GlobalId, Index>;

inline std::vector<Pair> pairs(const ContactSearch& search) {
  std::vector<Pair> result;
  for (const ContactCouple& c : search.contact().couples)
    result.emplace_back(search.contact().id(c.point), c.contactor);
  return result;
}

}  // namespace breccia::test
