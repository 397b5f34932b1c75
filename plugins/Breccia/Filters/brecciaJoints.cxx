#include "brecciaJoints.h"

#include <algorithm>
#include <cmath>

#include "vtkMath.h"

namespace breccia {
namespace {

/// The middle of a face of an element whose joint has failed; `seen_from`: the element across.
struct FaceCentre {
  vtkTypeInt64 element, seen_from;
  Vector centre;
  bool operator<(const FaceCentre& other) const {
    return element != other.element ? element < other.element : seen_from < other.seen_from;
  }
};

Vector Centre(const Elements& elements, vtkIdType e, int face) {
  Vector centre{};
  for (const int corner : kFaceCorners[face]) {
    for (std::size_t k = 0; k < 3; ++k)
      centre[k] += elements.corners[static_cast<std::size_t>(12 * e + 3 * corner) + k] / 3;
  }
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

void SetJumps(const Elements& elements, const Ranks& ranks, std::vector<FailedJoint>& joints) {
  std::vector<vtkTypeInt64> low;  // elements of lower id of the joints
  for (const FailedJoint& joint : joints) low.push_back(joint.id / 4);
  std::vector<FaceCentre> mine, other;
  for (vtkIdType e = 0; e < elements.Count(); ++e) {
    for (int f = 0; f < 4; ++f) {
      const vtkTypeInt64 own = elements.id[static_cast<std::size_t>(e)];
      const vtkTypeInt64 across = elements.neighbour[static_cast<std::size_t>(4 * e + f)];
      const bool near = std::binary_search(low.begin(), low.end(), own) && across > own;
      const bool far = across >= 0 && across < own && std::binary_search(low.begin(), low.end(), across);
      if (near) mine.push_back({4 * own + f, across, Centre(elements, e, f)});
      if (far) other.push_back({across, own, Centre(elements, e, f)});
    }
  }
  mine = ranks.Gather(mine);
  other = ranks.Gather(other);
  std::sort(mine.begin(), mine.end());
  std::sort(other.begin(), other.end());
  for (FailedJoint& joint : joints) {
    const auto near = std::lower_bound(mine.begin(), mine.end(), FaceCentre{joint.id, -1, {}});
    if (near == mine.end() || near->element != joint.id) continue;
    const FaceCentre wanted{joint.id / 4, near->seen_from, {}};
    const auto far = std::lower_bound(other.begin(), other.end(), wanted);
    if (far == other.end() || wanted < *far) continue;
    joint.jump = Difference(far->centre, near->centre);
  }
}

}  // namespace breccia
