#include "physics/contact/step/contact_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>
#include <unordered_map>
#include <utility>

#include <Eigen/Eigenvalues>

#include "base/index.hpp"
#include "mesh/tetrahedron.hpp"
#include "physics/contact/contact_field.hpp"
#include "physics/contact/contact_point.hpp"
#include "physics/contact/step/bound.hpp"
#include "physics/contact/step/nearby.hpp"

namespace breccia {
namespace {

using Patch = ContactPatch;

/// Geometry of an open face at rest.
struct Face {
  Vec3 normal;     ///< -
  double area;     ///< m2
  double longest;  ///< m, edge
};

Face face_at_rest(const LocalMesh& mesh, Index slot, int face) {
  std::array<Vec3, 3> x;
  for (std::size_t i = 0; i < 3; ++i)
    x[i] = load_node(mesh.reference.data(), mesh.corner_node(slot, kFaceCorners[static_cast<std::size_t>(face)][i]));
  const Vec3 across = (x[1] - x[0]).cross(x[2] - x[0]);
  const double doubled = across.norm();
  const double square =
      std::max({(x[1] - x[0]).squaredNorm(), (x[2] - x[1]).squaredNorm(), (x[0] - x[2]).squaredNorm()});
  return {across / doubled, 0.5 * doubled, std::sqrt(square)};
}

/// Stiffest elastic friction over stiffest normal contact of any law.
double tangential_share(const ContactParams& params) {
  double largest = 0;
  for (const ContactLaw& law : params.laws) {
    if (law.active() && law.friction > 0)
      largest = std::max(largest, law.tangential_ratio * law.penalty / stiffest_slope(law));
  }
  return std::min(largest, 1.0);
}

/// Slopes of law and field as contact_forces uses them.
class Surface {
 public:
  explicit Surface(const ContactStepModel& model)
      : model_(model),
        tangential_(tangential_share(model.params)),
        one_point_(model.params.points_per_face == 1),
        scale_(at(model.mesh.num_nodes - model.mesh.num_own_nodes()), 1.0) {
    const LocalMesh& mesh = model.mesh;
    for (Index n = mesh.num_own_nodes(); n < mesh.num_nodes; ++n) {
      if (model.held[at(n)] != 0) scale_[at(n - mesh.num_own_nodes())] = 0.0;
    }
    for (int power = 0; power < 2; ++power) improve_scale();
    shared_.assign(scale_.size(), Mat3::Zero());
    for_each_shared_corner([&](Index place, const Mat3& face, double share) { shared_[at(place)] += share * face; });
  }

  template <class F>
  void for_each_open(Index slot, F&& f) const {
    if (model_.mesh.element_of_slot[at(slot)] < 0) return;
    for (int face = 0; face < 4; ++face) {
      if ((model_.faces.open[at(slot)] >> face & 1) != 0) f(face);
    }
  }

  [[nodiscard]] ContactElement element(Index slot) const {
    const auto find = [&] {
      ContactElement element;
      set_corners(slot, element);
      for_each_open(slot, [&](int face) {
        const Face shape = face_at_rest(model_.mesh, slot, face);
        element.area[static_cast<std::size_t>(face)] = shape.area;
        element.longest[static_cast<std::size_t>(face)] = shape.longest;
        element.steepness[static_cast<std::size_t>(face)] = steepness(slot, face);
      });
      return element;
    };
    if (model_.known == nullptr || slot >= model_.mesh.num_own_slots) return find();
    return model_.known->of(slot, model_.mesh.num_slots, cause(slot), find);
  }

 private:
  [[nodiscard]] Index contactor_of(Index slot) const {
    return model_.state != nullptr ? model_.state->contactor_of_slot[at(slot)] : -1;
  }

  /// What an element with its own nodes depends on. Depths of the overlap field stay as they are.
  [[nodiscard]] ContactElements::Cause cause(Index slot) const {
    const Index contactor = contactor_of(slot);
    unsigned held = 0;
    for (int c = 0; c < 4; ++c) {
      if (model_.held[at(model_.mesh.corner_node(slot, c))] != 0) held |= 1U << c;
    }
    return {.open = model_.faces.open[at(slot)],
            .held = static_cast<std::uint8_t>(held),
            .sets = contactor >= 0 ? std::int32_t{model_.state->field[at(contactor)].sets} : -1};
  }

  /// A_i/m_i and 1/m_i of an element's corners on its open faces; 0 for others and constrained ones.
  void set_corners(Index slot, ContactElement& element) const {
    const LocalMesh& mesh = model_.mesh;
    std::array<Mat3, 4> sum;
    unsigned on_open = 0;
    for (Mat3& m : sum) m.setZero();
    for_each_open(slot, [&](int face) {
      for (const int corner : kFaceCorners[static_cast<std::size_t>(face)]) on_open |= 1U << corner;
      if (slot >= mesh.num_own_slots) return;
      const Mat3 third = face_matrix(slot, face) / 3.0;
      for (const int corner : kFaceCorners[static_cast<std::size_t>(face)])
        sum[static_cast<std::size_t>(corner)] += third;
    });
    for (int c = 0; c < 4; ++c) {
      const Index node = mesh.corner_node(slot, c);
      if ((on_open >> c & 1) == 0 || model_.held[at(node)] != 0) continue;
      const Mat3& area =
          slot < mesh.num_own_slots ? sum[static_cast<std::size_t>(c)] : shared_[at(node - mesh.num_own_nodes())];
      const double per_mass = 1.0 / mesh.node_mass[at(node)];
      element.area_over_mass[static_cast<std::size_t>(c)] = largest_direction(area) * per_mass;
      element.per_mass[static_cast<std::size_t>(c)] = per_mass;
    }
  }

  /// G^2 of the field of an element that is touched through a face, which is or may become one of the free surface: the
  /// largest of its functions at rest.
  [[nodiscard]] double steepness(Index slot, int face) const {
    const LocalMesh& mesh = model_.mesh;
    const Index contactor = contactor_of(slot);
    FieldValues values;
    values.depth.fill(std::numeric_limits<double>::max());  // where it is not known; the height is less
    if (contactor >= 0) values = model_.state->field[at(contactor)];
    values.sets |= 1 << (15 ^ 1 << face);
    const double length = model_.body_length[at(mesh.slot_body[at(slot)])];
    const OverlapShape shape = overlap_shape(model_.params, heights(mesh, slot), values, length);
    double square = 0;
    for (std::size_t k = 0; k < shape.rows; ++k) {
      // Of elements with a field of their own the face's function alone.
      if (model_.params.field == OverlapField::body || k == static_cast<std::size_t>(face))
        square = std::max(square, slope_squared(slot, shape.row[k]));
    }
    return square;
  }

  /// |sum_a row[a] grad lambda_a|^2 at rest.
  [[nodiscard]] double slope_squared(Index slot, const std::array<double, 4>& row) const {
    const LocalMesh& mesh = model_.mesh;
    Vec3 slope = Vec3::Zero();
    for (std::size_t c = 1; c < 4; ++c) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double gradient = mesh.gradient[at(slot / kLanes) * 72 + (3 * (c - 1) + k) * kLanes + at(slot % kLanes)];
        slope[static_cast<Eigen::Index>(k)] += (row[c] - row[0]) * gradient;
      }
    }
    return slope.squaredNorm();
  }

  /// Calls f(place, face's matrix, x_i's share of it) for the corners of open faces on shared nodes that are not
  /// constrained.
  template <class F>
  void for_each_shared_corner(F&& f) const {
    const LocalMesh& mesh = model_.mesh;
    for (Index s = mesh.num_own_slots; s < mesh.num_slots; ++s) {
      for_each_open(s, [&](int face) {
        const Mat3 matrix = face_matrix(s, face);
        std::array<Index, 3> place;
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          place[i] = mesh.corner_node(s, kFaceCorners[static_cast<std::size_t>(face)][i]) - mesh.num_own_nodes();
          sum += scale_[at(place[i])];
        }
        for (const Index i : place) {
          const double x = scale_[at(i)];
          if (!(x > 0)) continue;
          const double spread = (x + sum) / (12.0 * x);
          f(i, matrix, one_point_ ? std::max(spread, sum / (9.0 * x)) : spread);
        }
      });
    }
  }

  void improve_scale() {
    const LocalMesh& mesh = model_.mesh;
    std::vector<double> next(scale_.size(), 0.0);
    for_each_shared_corner([&](Index place, const Mat3& face, double share) {
      next[at(place)] += scale_[at(place)] * share * face.trace() / mesh.node_mass[at(place + mesh.num_own_nodes())];
    });
    scale_.swap(next);
  }

  /// The face's area: all of it along the normal, what friction holds across it.
  [[nodiscard]] Mat3 face_matrix(Index slot, int face) const {
    const Face f = face_at_rest(model_.mesh, slot, face);
    return f.area * ((1.0 - tangential_) * f.normal * f.normal.transpose() + tangential_ * Mat3::Identity());
  }
  [[nodiscard]] static double largest_direction(const Mat3& m) {
    Eigen::SelfAdjointEigenSolver<Mat3> solver;
    return solver.computeDirect(m, Eigen::EigenvaluesOnly).eigenvalues()[2];
  }

  const ContactStepModel& model_;
  double tangential_;
  bool one_point_;
  std::vector<double> scale_;  ///< (shared nodes) x
  std::vector<Mat3> shared_;   ///< (shared nodes) A_i
};

std::int64_t level_of(double edge) { return std::ilogb(edge); }

using Key = decltype(Patch().key());
struct KeyHash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t sum = 0;
    const auto add = [&](std::int64_t part) {
      sum = (sum ^ static_cast<std::uint64_t>(part)) * 0x9e3779b97f4a7c15ULL + (sum >> 29);
    };
    std::apply([&](auto... parts) { (add(parts), ...); }, key);
    return sum;
  }
};

void take_vector(Patch& patch, std::size_t first, const Vec3& x) {
  for (std::size_t i = 0; i < 3; ++i) {
    patch.raise(first + i, -x[static_cast<Eigen::Index>(i)]);
    patch.raise(first + 3 + i, x[static_cast<Eigen::Index>(i)]);
  }
}

/// The patch that an open face belongs to, without numbers.
/// @param longest  m, edge
Patch patch_of(const LocalMesh& mesh, Index slot, int face, double longest, const Field<double>& position,
               double coarsening) {
  Patch patch;
  patch.level = level_of(longest);
  patch.group = mesh.block_group[at(slot / kLanes)];
  patch.body = mesh.slot_body[at(slot)];
  Vec3 sum = Vec3::Zero();
  for (const int c : kFaceCorners[static_cast<std::size_t>(face)])
    sum += load_node(position.data(), mesh.corner_node(slot, c));
  const double edge = kCellSizes * coarsening * patch.face_size();
  for (std::size_t i = 0; i < 3; ++i)
    patch.cell[i] = static_cast<std::int64_t>(std::floor(sum[static_cast<Eigen::Index>(i)] / (3.0 * edge)));
  patch.largest.fill(-std::numeric_limits<double>::infinity());
  return patch;
}

/// Whether any of a patch can be outside the sphere within `time`.
bool may_pass(const SphericalBoundary& sphere, const Patch& p, double time) {
  double distance = 0, speed = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double centre = sphere.centre[static_cast<Eigen::Index>(i)];
    const double d = std::max(p.high(Patch::box, i) - centre, centre - p.low(Patch::box, i));
    const double v = std::max(p.high(Patch::velocity, i), -p.low(Patch::velocity, i));
    distance += d * d;
    speed += v * v;
  }
  return std::sqrt(distance) + kSpeedMargin * std::sqrt(speed) * time + kSizeMargin * p.face_size() > sphere.radius;
}

}  // namespace

double stiffest_slope(const ContactLaw& law) { return law.exponent * law.penalty; }

ContactPatches contact_patches(const ContactStepModel& model, const Field<double>& position,
                               const Field<double>& velocity, double coarsening) {
  const LocalMesh& mesh = model.mesh;
  const Surface surface(model);
  const FaceRule& rule = face_rule(model.params.points_per_face);
  const double largest_share = *std::max_element(rule.share.begin(), rule.share.begin() + rule.num_points);
  ContactPatches patches;
  patches.place.assign(4 * at(mesh.num_slots), -1);
  std::unordered_map<Key, Index, KeyHash> known;  // to the place in the list
  for (Index s = 0; s < mesh.num_slots; ++s) {
    if (!mesh.is_original(s) || model.faces.open[at(s)] == 0) continue;
    const ContactElement element = surface.element(s);
    surface.for_each_open(s, [&](int face) {
      const auto f = static_cast<std::size_t>(face);
      const Patch empty = patch_of(mesh, s, face, element.longest[f], position, coarsening);
      const auto [found, fresh] = known.emplace(empty.key(), static_cast<Index>(patches.list.size()));
      if (fresh) patches.list.push_back(empty);
      patches.place[at(4 * s + face)] = found->second;
      Patch& patch = patches.list[at(found->second)];
      for (const int c : kFaceCorners[static_cast<std::size_t>(face)]) {
        const Index node = mesh.corner_node(s, c);
        take_vector(patch, Patch::box, load_node(position.data(), node));
        take_vector(patch, Patch::reference_box, load_node(mesh.reference.data(), node));
        take_vector(patch, Patch::velocity, load_node(velocity.data(), node));
        patch.raise(Patch::area_over_mass, element.area_over_mass[static_cast<std::size_t>(c)]);
        patch.raise(Patch::per_mass, element.per_mass[static_cast<std::size_t>(c)]);
      }
      patch.raise(Patch::steepness, element.steepness[f]);
      patch.raise(Patch::weight, (model.faces.pointed[at(s)] >> face & 1) != 0 ? largest_share * element.area[f] : 0.0);
      patch.raise(Patch::per_length, 1.0 / model.body_length[at(mesh.slot_body[at(s)])]);
      patch.raise(Patch::torn, (model.faces.torn[at(s)] >> face & 1) != 0 ? 1.0 : 0.0);
    });
  }
  patches.sort();
  return patches;
}

class ContactShares::Impl {
 public:
  Impl(const ContactStepModel& model, const ContactPatches& patches, double time)
      : model_(model),
        patches_(patches),
        time_(time),
        surface_(model_),
        nearby_(model_.params, patches.list, time),
        near_(patches.list.size()),
        at_most_(patches.list.size(), kUnknown) {}

  [[nodiscard]] ContactShare of(Index slot) {
    ContactShare share;
    if (model_.faces.open[at(slot)] == 0) return share;
    const ContactElement element = surface_.element(slot);
    surface_.for_each_open(slot, [&](int face) {
      const auto raise_corner = [&](int corner, double omega_squared, Index against) {
        if (omega_squared > share.largest()) {
          share.face = face;
          share.against = against;
        }
        double& largest = share.omega_squared[static_cast<std::size_t>(corner)];
        largest = std::max(largest, omega_squared);
      };
      const Index place = place_of(slot, face);
      const bool at_sphere = meets_sphere(place);
      for (const int c : kFaceCorners[static_cast<std::size_t>(face)]) {
        const double area = element.area_over_mass[static_cast<std::size_t>(c)];
        const double wall = at_sphere ? wall_share(place, area) : 0.0;
        if (at_sphere) raise_corner(c, wall, -1);
        const double per_mass = element.per_mass[static_cast<std::size_t>(c)];
        for (const ContactBound& m : near(place)) raise_corner(c, wall + m.share(area, per_mass), m.against);
      }
    });
    return share;
  }

  [[nodiscard]] double at_most(Index slot) {
    double largest = 0;
    surface_.for_each_open(slot,
                           [&](int face) { largest = std::max(largest, at_most_of_patch(place_of(slot, face))); });
    return largest;
  }

 private:
  static constexpr double kUnknown = -1;

  [[nodiscard]] Index place_of(Index slot, int face) const { return patches_.place[at(4 * slot + face)]; }
  [[nodiscard]] const Patch& patch(Index place) const { return patches_.list[at(place)]; }
  [[nodiscard]] bool meets_sphere(Index place) const {
    const auto& sphere = model_.params.sphere;
    return sphere && patch(place).largest[Patch::weight] > 0 && may_pass(*sphere, patch(place), time_);
  }
  [[nodiscard]] double wall_share(Index place, double area_over_mass) const {
    return model_.params.sphere->penalty * patch(place).largest[Patch::per_length] * area_over_mass;
  }
  [[nodiscard]] const std::vector<ContactBound>& near(Index place) {
    Near& near = near_[at(place)];
    if (!near.found) near = {true, nearby_.bounds(at(place))};
    return near.bounds;
  }
  [[nodiscard]] double at_most_of_patch(Index place) {
    double& most = at_most_[at(place)];
    if (most != kUnknown) return most;
    const double area = patch(place).largest[Patch::area_over_mass], per_mass = patch(place).largest[Patch::per_mass];
    const double wall = meets_sphere(place) ? wall_share(place, area) : 0.0;
    most = wall;
    for (const ContactBound& m : nearby_.bounds_anywhere(patch(place)))
      most = std::max(most, wall + m.share(area, per_mass));
    return most;
  }

  struct Near {
    bool found = false;
    std::vector<ContactBound> bounds;
  };
  ContactStepModel model_;
  const ContactPatches& patches_;
  double time_;
  Surface surface_;
  PatchesNearby nearby_;
  std::vector<Near> near_;       ///< (patches) of those that have been requested
  std::vector<double> at_most_;  ///< (patches) 1/s2, or kUnknown
};

ContactShares::ContactShares(const ContactStepModel& model, const ContactPatches& patches, double time)
    : impl_(patches.list.empty() ? nullptr : std::make_unique<Impl>(model, patches, time)) {}
ContactShares::~ContactShares() = default;

ContactShare ContactShares::of(Index slot) { return impl_ ? impl_->of(slot) : ContactShare{}; }
double ContactShares::at_most(Index slot) { return impl_ ? impl_->at_most(slot) : 0.0; }

std::vector<ContactShare> contact_shares(const ContactStepModel& model, const ContactPatches& patches, double time) {
  ContactShares of_slots(model, patches, time);
  std::vector<ContactShare> shares(at(model.mesh.num_slots));
  for (Index s = 0; s < model.mesh.num_slots; ++s) {
    if (model.mesh.is_original(s)) shares[at(s)] = of_slots.of(s);
  }
  return shares;
}

}  // namespace breccia
