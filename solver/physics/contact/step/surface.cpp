#include "physics/contact/step/surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include "physics/contact/geometry/field.hpp"

namespace breccia {
namespace {

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

double largest_direction(const Mat3& m) {
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  return solver.computeDirect(m, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

}  // namespace

/// Calls f(place, face's matrix, x_i's share of it) for the corners of open faces on shared nodes that are not
/// constrained.
template <class F>
void ContactSurface::for_each_shared_corner(F&& f) const {
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

ContactSurface::ContactSurface(const ContactStepModel& model, bool shared)
    : model_(model), tangential_(tangential_share(model.params)), one_point_(model.params.points_per_face == 1) {
  if (!shared) return;
  const LocalMesh& mesh = model.mesh;
  scale_.assign(at(mesh.num_nodes - mesh.num_own_nodes()), 1.0);
  for (Index n = mesh.num_own_nodes(); n < mesh.num_nodes; ++n) {
    if (model.held[at(n)] != 0) scale_[at(n - mesh.num_own_nodes())] = 0.0;
  }
  for (int power = 0; power < 2; ++power) improve_scale();
  shared_.assign(scale_.size(), Mat3::Zero());
  for_each_shared_corner([&](Index place, const Mat3& face, double share) { shared_[at(place)] += share * face; });
}

ContactElement ContactSurface::element(Index slot) const {
  ContactElement element;
  set_corners(slot, element);
  for_each_open(slot, [&](int face) {
    const Face shape = face_at_rest(model_.mesh, slot, face);
    element.area[at(face)] = shape.area;
    element.longest[at(face)] = shape.longest;
    element.steepness[at(face)] = steepness(slot, face);
  });
  return element;
}

/// A_i/m_i and 1/m_i of an element's corners on its open faces; 0 for others and constrained ones.
void ContactSurface::set_corners(Index slot, ContactElement& element) const {
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
  // Corners of its own on the same open faces have the same sum.
  const auto faces_at = [&](int corner) { return model_.faces.open[at(slot)] & ~(1U << corner); };
  int solved = -1;
  double direction = 0;
  for (int c = 0; c < 4; ++c) {
    const Index node = mesh.corner_node(slot, c);
    if ((on_open >> c & 1) == 0 || model_.held[at(node)] != 0) continue;
    const Mat3& area =
        slot < mesh.num_own_slots ? sum[static_cast<std::size_t>(c)] : shared_[at(node - mesh.num_own_nodes())];
    const double per_mass = 1.0 / mesh.node_mass[at(node)];
    const bool same = slot < mesh.num_own_slots && solved >= 0 && faces_at(c) == faces_at(solved);
    if (!same) direction = largest_direction(area);
    solved = c;
    element.area_over_mass[static_cast<std::size_t>(c)] = direction * per_mass;
    element.per_mass[static_cast<std::size_t>(c)] = per_mass;
  }
}

/// G^2 of the field of an element that is touched through a face, which is or may become one of the free surface: the
/// largest of its functions at rest.
double ContactSurface::steepness(Index slot, int face) const {
  const LocalMesh& mesh = model_.mesh;
  const Index contactor = model_.state != nullptr ? model_.state->contactor_of_slot[at(slot)] : -1;
  FieldValues values;
  values.depth.fill(std::numeric_limits<double>::max());  // where it is not known; the height is less
  if (contactor >= 0) values = model_.state->field[at(contactor)];
  const unsigned set = face_set(at(face));
  if (!on_one_face(values.sides, set)) values.sides |= 1 << set;
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
double ContactSurface::slope_squared(Index slot, const std::array<double, 4>& row) const {
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

void ContactSurface::improve_scale() {
  const LocalMesh& mesh = model_.mesh;
  std::vector<double> next(scale_.size(), 0.0);
  for_each_shared_corner([&](Index place, const Mat3& face, double share) {
    next[at(place)] += scale_[at(place)] * share * face.trace() / mesh.node_mass[at(place + mesh.num_own_nodes())];
  });
  scale_.swap(next);
}

/// The face's area: all of it along the normal, what friction holds across it.
Mat3 ContactSurface::face_matrix(Index slot, int face) const {
  const Face f = face_at_rest(model_.mesh, slot, face);
  return f.area * ((1.0 - tangential_) * f.normal * f.normal.transpose() + tangential_ * Mat3::Identity());
}

}  // namespace breccia
