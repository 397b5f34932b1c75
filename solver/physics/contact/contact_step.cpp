#include "physics/contact/contact_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <Eigen/Eigenvalues>

#include "mesh/tetrahedron.hpp"
#include "physics/contact/contact_bound.hpp"
#include "physics/contact/contact_field.hpp"
#include "physics/contact/contact_point.hpp"
#include "physics/contact/patch_tree.hpp"

namespace breccia {
namespace {

using Patch = ContactPatch;

/// Patches come near each other by this share of their faces' size however slow they are.
constexpr double kSizeMargin = 0.25;
/// A body meets itself where faces have come so much closer together than they were at rest; turning alone can make
/// the box around something larger by 1.73.
constexpr double kFolded = 2.0;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

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

  /// A_i/m_i and 1/m_i of an element's corners on its open faces; 0 for others and held ones.
  struct Nodes {
    std::array<double, 4> area_over_mass{}, per_mass{};
  };
  [[nodiscard]] Nodes nodes_of(Index slot) const {
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
    Nodes nodes;
    for (int c = 0; c < 4; ++c) {
      const Index node = mesh.corner_node(slot, c);
      if ((on_open >> c & 1) == 0 || model_.held[at(node)] != 0) continue;
      const Mat3& area =
          slot < mesh.num_own_slots ? sum[static_cast<std::size_t>(c)] : shared_[at(node - mesh.num_own_nodes())];
      const double per_mass = 1.0 / mesh.node_mass[at(node)];
      nodes.area_over_mass[static_cast<std::size_t>(c)] = largest_direction(area) * per_mass;
      nodes.per_mass[static_cast<std::size_t>(c)] = per_mass;
    }
    return nodes;
  }

  /// G^2 of the field of an element that is touched through a face, which is or may become one of the free surface: the
  /// largest of its functions at rest.
  [[nodiscard]] double steepness(Index slot, int face) const {
    const LocalMesh& mesh = model_.mesh;
    const ContactState* state = model_.state;
    const Index contactor = state != nullptr ? state->contactor_of_slot[at(slot)] : -1;
    FieldValues values;
    values.depth.fill(std::numeric_limits<double>::max());  // where it is not known; the height is less
    if (contactor >= 0) values = state->field[at(contactor)];
    values.sets |= 1 << (15 ^ 1 << face);
    const double length = model_.body_length[at(mesh.slot_body[at(slot)])];
    const OverlapShape shape = overlap_shape(model_.params, mesh, slot, values, length);
    double square = 0;
    for (std::size_t k = 0; k < shape.rows; ++k) {
      // Of elements with a field of their own the face's function alone.
      if (model_.params.field == OverlapField::body || k == static_cast<std::size_t>(face))
        square = std::max(square, slope_squared(slot, shape.row[k]));
    }
    return square;
  }

 private:
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

  /// Calls f(place, face's matrix, x_i's share of it) for the corners of open faces on shared nodes that are not held.
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
double size_of(std::int64_t level) { return std::ldexp(1.0, static_cast<int>(level) + 1); }

auto key_of(const Patch& p) { return std::tuple(p.level, p.group, p.body, p.cell[0], p.cell[1], p.cell[2]); }
bool before(const Patch& p, const Patch& q) { return key_of(p) < key_of(q); }

void raise(double& largest, double value) { largest = value > largest ? value : largest; }

void take_vector(Patch& patch, std::size_t first, const Vec3& x) {
  for (std::size_t i = 0; i < 3; ++i) {
    raise(patch.largest[first + i], -x[static_cast<Eigen::Index>(i)]);
    raise(patch.largest[first + 3 + i], x[static_cast<Eigen::Index>(i)]);
  }
}

/// The patch that an open face belongs to, without numbers.
Patch patch_of(const LocalMesh& mesh, Index slot, int face, const Face& shape, const Field<double>& position,
               double coarsening) {
  Patch patch;
  patch.level = level_of(shape.longest);
  patch.group = mesh.block_group[at(slot / kLanes)];
  patch.body = mesh.slot_body[at(slot)];
  Vec3 sum = Vec3::Zero();
  for (const int c : kFaceCorners[static_cast<std::size_t>(face)])
    sum += load_node(position.data(), mesh.corner_node(slot, c));
  const double edge = kCellSizes * coarsening * size_of(patch.level);
  for (std::size_t i = 0; i < 3; ++i)
    patch.cell[i] = static_cast<std::int64_t>(std::floor(sum[static_cast<Eigen::Index>(i)] / (3.0 * edge)));
  patch.largest.fill(-std::numeric_limits<double>::infinity());
  return patch;
}

double low(const Patch& p, std::size_t first, std::size_t axis) { return -p.largest[first + axis]; }
double high(const Patch& p, std::size_t first, std::size_t axis) { return p.largest[first + 3 + axis]; }

/// Square of the distance of two boxes, m2.
double gap_squared(const Patch& p, const Patch& q, std::size_t first) {
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double gap = std::max({0.0, low(q, first, i) - high(p, first, i), low(p, first, i) - high(q, first, i)});
    square += gap * gap;
  }
  return square;
}

double diagonal_of_both(const Patch& p, const Patch& q, std::size_t first) {
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = std::max(high(p, first, i), high(q, first, i)) - std::min(low(p, first, i), low(q, first, i));
    square += length * length;
  }
  return std::sqrt(square);
}

double relative_speed(const Patch& p, const Patch& q) {
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double v = std::max(high(p, Patch::velocity, i) - low(q, Patch::velocity, i),
                              high(q, Patch::velocity, i) - low(p, Patch::velocity, i));
    square += v * v;
  }
  return std::sqrt(square);
}

/// Whether two patches belong to different bodies, or to parts of one that can meet.
bool apart(const Patch& p, const Patch& q) {
  if (p.body != q.body) return true;
  if (p.largest[Patch::torn] > 0 || q.largest[Patch::torn] > 0) return true;
  return diagonal_of_both(p, q, Patch::reference_box) > kFolded * diagonal_of_both(p, q, Patch::box);
}

bool may_meet(const ContactParams& params, const Patch& p, const Patch& q, double time) {
  const auto felt = [&](const Patch& points, const Patch& other) {
    return points.largest[Patch::weight] > 0 &&
           params.law(static_cast<Index>(points.group), static_cast<Index>(other.group)).active();
  };
  if (!felt(p, q) && !felt(q, p)) return false;
  const double reach = kSpeedMargin * relative_speed(p, q) * time + kSizeMargin * size_of(std::min(p.level, q.level));
  return gap_squared(p, q, Patch::box) <= reach * reach && apart(p, q);
}

/// Whether any of a patch can be outside the sphere within `time`.
bool may_pass(const SphericalBoundary& sphere, const Patch& p, double time) {
  double distance = 0, speed = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double centre = sphere.centre[static_cast<Eigen::Index>(i)];
    const double d = std::max(high(p, Patch::box, i) - centre, centre - low(p, Patch::box, i));
    const double v = std::max(high(p, Patch::velocity, i), -low(p, Patch::velocity, i));
    distance += d * d;
    speed += v * v;
  }
  return std::sqrt(distance) + kSpeedMargin * std::sqrt(speed) * time + kSizeMargin * size_of(p.level) > sphere.radius;
}

/// Boxes that overlap where patches may meet: grown by their speeds against one that all share, and their size.
std::vector<PatchTree::Box> grown_boxes(std::span<const Patch> patches, double time) {
  Patch all = patches.front();
  for (const Patch& p : patches) {
    for (std::size_t k = Patch::velocity; k < Patch::velocity + 6; ++k) raise(all.largest[k], p.largest[k]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double middle = 0.5 * (low(all, Patch::velocity, i) + high(all, Patch::velocity, i));
    all.largest[Patch::velocity + i] = -middle;
    all.largest[Patch::velocity + 3 + i] = middle;
  }
  std::vector<PatchTree::Box> boxes;
  boxes.reserve(patches.size());
  for (const Patch& p : patches) {
    const double grown = 1.001 * (kSpeedMargin * relative_speed(p, all) * time + kSizeMargin * size_of(p.level));
    PatchTree::Box& box = boxes.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      box.low[i] = low(p, Patch::box, i) - grown;
      box.high[i] = high(p, Patch::box, i) + grown;
    }
  }
  return boxes;
}

}  // namespace

double stiffest_slope(const ContactLaw& law) { return law.exponent * law.penalty; }

std::vector<ContactPatch> contact_patches(const ContactStepModel& model, const Field<double>& position,
                                          const Field<double>& velocity, double coarsening) {
  const LocalMesh& mesh = model.mesh;
  const Surface surface(model);
  const FaceRule& rule = face_rule(model.params.points_per_face);
  const double largest_share = *std::max_element(rule.share.begin(), rule.share.begin() + rule.num_points);
  std::vector<Patch> patches;
  for (Index s = 0; s < mesh.num_slots; ++s) {
    if (!mesh.is_original(s) || model.faces.open[at(s)] == 0) continue;
    const Surface::Nodes nodes = surface.nodes_of(s);
    surface.for_each_open(s, [&](int face) {
      const Face shape = face_at_rest(mesh, s, face);
      Patch& patch = patches.emplace_back(patch_of(mesh, s, face, shape, position, coarsening));
      for (const int c : kFaceCorners[static_cast<std::size_t>(face)]) {
        const Index node = mesh.corner_node(s, c);
        take_vector(patch, Patch::box, load_node(position.data(), node));
        take_vector(patch, Patch::reference_box, load_node(mesh.reference.data(), node));
        take_vector(patch, Patch::velocity, load_node(velocity.data(), node));
      }
      for (const int c : kFaceCorners[static_cast<std::size_t>(face)]) {
        raise(patch.largest[Patch::area_over_mass], nodes.area_over_mass[static_cast<std::size_t>(c)]);
        raise(patch.largest[Patch::per_mass], nodes.per_mass[static_cast<std::size_t>(c)]);
      }
      patch.largest[Patch::steepness] = surface.steepness(s, face);
      patch.largest[Patch::weight] = (model.faces.pointed[at(s)] >> face & 1) != 0 ? largest_share * shape.area : 0.0;
      patch.largest[Patch::per_length] = 1.0 / model.body_length[at(mesh.slot_body[at(s)])];
      patch.largest[Patch::torn] = (model.faces.torn[at(s)] >> face & 1) != 0 ? 1.0 : 0.0;
    });
  }
  merge(patches);
  return patches;
}

void merge(std::vector<ContactPatch>& patches) {
  std::sort(patches.begin(), patches.end(), before);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (kept > 0 && key_of(patches[kept - 1]) == key_of(patches[i])) {
      for (std::size_t k = 0; k < Patch::count; ++k) raise(patches[kept - 1].largest[k], patches[i].largest[k]);
    } else {
      patches[kept++] = Patch(patches[i]);
    }
  }
  patches.resize(kept);
}

std::vector<ContactShare> contact_shares(const ContactStepModel& model, const Field<double>& position,
                                         double coarsening, std::span<const ContactPatch> patches, double time) {
  const LocalMesh& mesh = model.mesh;
  std::vector<ContactShare> shares(at(mesh.num_slots));
  if (patches.empty()) return shares;
  const Surface surface(model);
  const std::vector<PatchTree::Box> boxes = grown_boxes(patches, time);
  const PatchTree tree(boxes);
  struct Near {
    bool found = false;
    std::vector<ContactBound> bounds;
  };
  std::vector<Near> near(patches.size());  // of those that originals here belong to
  const auto near_of = [&](std::size_t p) -> const std::vector<ContactBound>& {
    if (!near[p].found) {
      near[p].found = true;
      tree.query(boxes[p], [&](std::int32_t place) {
        const Patch& q = patches[static_cast<std::size_t>(place)];
        if (may_meet(model.params, patches[p], q, time))
          add_bound(contact_bound(model.params, patches[p], q), near[p].bounds);
      });
    }
    return near[p].bounds;
  };
  for (Index s = 0; s < mesh.num_slots; ++s) {
    if (!mesh.is_original(s) || model.faces.open[at(s)] == 0) continue;
    const Surface::Nodes nodes = surface.nodes_of(s);
    surface.for_each_open(s, [&](int face) {
      const Patch key = patch_of(mesh, s, face, face_at_rest(mesh, s, face), position, coarsening);
      const auto place =
          static_cast<std::size_t>(std::lower_bound(patches.begin(), patches.end(), key, before) - patches.begin());
      const Patch& mine = patches[place];
      ContactShare& share = shares[at(s)];
      const auto raise_corner = [&](int corner, double omega_squared, Index against) {
        if (omega_squared > share.largest()) {
          share.face = face;
          share.against = against;
        }
        raise(share.omega_squared[static_cast<std::size_t>(corner)], omega_squared);
      };
      const auto& sphere = model.params.sphere;
      const bool at_sphere = sphere && mine.largest[Patch::weight] > 0 && may_pass(*sphere, mine, time);
      for (const int c : kFaceCorners[static_cast<std::size_t>(face)]) {
        const double area = nodes.area_over_mass[static_cast<std::size_t>(c)];
        const double wall = at_sphere ? sphere->penalty * mine.largest[Patch::per_length] * area : 0.0;
        if (at_sphere) raise_corner(c, wall, -1);
        const double per_mass = nodes.per_mass[static_cast<std::size_t>(c)];
        for (const ContactBound& m : near_of(place)) raise_corner(c, wall + m.share(area, per_mass), m.against);
      }
    });
  }
  return shares;
}

}  // namespace breccia
