#include "brecciaJoints.h"

#include <algorithm>
#include <cmath>

#include "vtkMath.h"

namespace breccia {
namespace {

/// A face of an element whose joint has failed; `seen_from`: the element across.
struct Face {
  vtkTypeInt64 element, seen_from;
  std::array<double, 9> corners;
  bool operator<(const Face& other) const {
    return element != other.element ? element < other.element : seen_from < other.seen_from;
  }
};

std::array<double, 9> FaceAt(const Elements& elements, vtkIdType e, int face) {
  std::array<double, 9> corners{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto from = static_cast<std::size_t>(12 * e + 3 * kFaceCorners[face][c]);
    for (std::size_t k = 0; k < 3; ++k) corners[3 * c + k] = elements.corners[from + k];
  }
  return corners;
}

Vector Centroid(const std::array<double, 9>& corners) {
  Vector centre{};
  for (std::size_t i = 0; i < 9; ++i) centre[i % 3] += corners[i] / 3;
  return centre;
}

}  // namespace

double Length(const Vector& a) { return std::sqrt(Dot(a, a)); }

Vector AreaVector(const double* x) {
  const Vector p{x[3] - x[0], x[4] - x[1], x[5] - x[2]}, q{x[6] - x[0], x[7] - x[1], x[8] - x[2]};
  return {(p[1] * q[2] - p[2] * q[1]) / 2, (p[2] * q[0] - p[0] * q[2]) / 2, (p[0] * q[1] - p[1] * q[0]) / 2};
}

void EigenSystem(const std::array<double, 6>& m, Vector& values, std::array<Vector, 3>& vectors) {
  double a[3][3] = {{m[0], m[3], m[5]}, {m[3], m[1], m[4]}, {m[5], m[4], m[2]}}, v[3][3];
  double *rows[3] = {a[0], a[1], a[2]}, *columns[3] = {v[0], v[1], v[2]};
  vtkMath::Jacobi(rows, values.data(), columns);
  for (std::size_t k = 0; k < 3; ++k) vectors[k] = {v[0][k], v[1][k], v[2][k]};
}

std::vector<FailedJoint> AllFailed(const Cracks& cracks, bool with_energy, const Ranks& ranks) {
  std::vector<FailedJoint> mine;
  std::string problem;
  try {
    const std::vector<double> opening = Numbers(cracks.grid, "opening");
    const std::vector<double> energy = with_energy ? Numbers(cracks.grid, "energy") : std::vector<double>();
    for (std::size_t i = 0; i < cracks.id.size(); ++i) {
      FailedJoint joint;
      joint.id = cracks.id[i];
      joint.mode = cracks.mode[i];
      joint.time = cracks.time[i];
      const auto cell = static_cast<std::size_t>(cracks.cell[i]);
      if (with_energy) joint.energy = energy[cell];
      joint.opening = opening[cell];
      const double* corners = &cracks.corners[9 * i];
      joint.normal = AreaVector(corners);
      joint.area = Length(joint.normal);
      for (std::size_t k = 0; k < 3; ++k) {
        joint.centre[k] = (corners[k] + corners[3 + k] + corners[6 + k]) / 3;
        if (joint.area > 0) joint.normal[k] /= joint.area;
        joint.jump[k] = joint.opening * joint.normal[k];
      }
      mine.push_back(joint);
    }
  } catch (const BadInput& bad) {
    problem = std::string("joints: ") + bad.what();
  }
  ranks.Agree(problem);
  std::vector<FailedJoint> all = ranks.Gather(mine);
  std::sort(all.begin(), all.end(), [](const FailedJoint& a, const FailedJoint& b) { return a.id < b.id; });
  return all;
}

double EnergyOfDamage(const Cracks& cracks, const Ranks& ranks) {
  struct Damaged {
    vtkTypeInt64 id;
    double energy;
  };
  std::vector<Damaged> mine;
  std::string problem;
  try {
    const std::vector<vtkTypeInt64> id = Integers(cracks.grid, "id");
    const std::vector<double> energy = Numbers(cracks.grid, "energy");
    std::vector<bool> failed(id.size());
    for (const vtkIdType cell : cracks.cell) failed[static_cast<std::size_t>(cell)] = true;
    for (std::size_t i = 0; i < id.size(); ++i) {
      if (!failed[i]) mine.push_back({id[i], energy[i]});
    }
  } catch (const BadInput& bad) {
    problem = std::string("joints: ") + bad.what();
  }
  ranks.Agree(problem);
  mine = ranks.Gather(mine);
  std::sort(mine.begin(), mine.end(), [](const Damaged& a, const Damaged& b) { return a.id < b.id; });
  double sum = 0;
  for (const Damaged& joint : mine) sum += joint.energy;
  return sum;
}

std::vector<FacePair> FacesOf(const Elements& elements, const Ranks& ranks, const std::vector<FailedJoint>& joints) {
  std::vector<vtkTypeInt64> low;  // elements of lower id of the joints
  for (const FailedJoint& joint : joints) low.push_back(joint.id / 4);
  std::vector<Face> mine, other;
  for (vtkIdType e = 0; e < elements.Count(); ++e) {
    for (int f = 0; f < 4; ++f) {
      const vtkTypeInt64 own = elements.id[static_cast<std::size_t>(e)];
      const vtkTypeInt64 across = elements.neighbour[static_cast<std::size_t>(4 * e + f)];
      const bool near = std::binary_search(low.begin(), low.end(), own) && across > own;
      const bool far = across >= 0 && across < own && std::binary_search(low.begin(), low.end(), across);
      if (near) mine.push_back({4 * own + f, across, FaceAt(elements, e, f)});
      if (far) other.push_back({across, own, FaceAt(elements, e, f)});
    }
  }
  mine = ranks.Gather(mine);
  other = ranks.Gather(other);
  std::sort(mine.begin(), mine.end());
  std::sort(other.begin(), other.end());
  std::vector<FacePair> pairs;
  for (const FailedJoint& joint : joints) {
    FacePair& pair = pairs.emplace_back();
    const auto near = std::lower_bound(mine.begin(), mine.end(), Face{joint.id, -1, {}});
    if (near == mine.end() || near->element != joint.id) continue;
    const Face wanted{joint.id / 4, near->seen_from, {}};
    const auto far = std::lower_bound(other.begin(), other.end(), wanted);
    if (far == other.end() || wanted < *far) continue;
    pair = {true, near->corners, Centroid(far->corners)};
  }
  return pairs;
}

FacePair Between(const FacePair& from, const FacePair& to, double share) {
  if (!from.found || !to.found) return from.found ? from : to;
  FacePair between = from;
  for (std::size_t i = 0; i < 9; ++i) between.near[i] += share * (to.near[i] - from.near[i]);
  for (std::size_t k = 0; k < 3; ++k) between.far[k] += share * (to.far[k] - from.far[k]);
  return between;
}

void SetJump(const FacePair& faces, FailedJoint& joint) {
  if (faces.found) joint.jump = Difference(faces.far, Centroid(faces.near));
}

void SetPlace(const FacePair& faces, FailedJoint& joint) {
  if (!faces.found) return;
  SetJump(faces, joint);
  const Vector centre = Centroid(faces.near);
  joint.normal = AreaVector(faces.near.data());
  joint.area = Length(joint.normal);
  for (std::size_t k = 0; k < 3; ++k) {
    joint.centre[k] = (centre[k] + faces.far[k]) / 2;
    if (joint.area > 0) joint.normal[k] /= joint.area;
  }
}

}  // namespace breccia
