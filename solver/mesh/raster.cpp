#include "mesh/raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "mesh/geometry.hpp"
#include "mesh/random_rotation.hpp"
#include "mesh/topology.hpp"

namespace breccia {
namespace {

constexpr const char* kName = "mesh.raster";
constexpr double kOnPlane = 1e-9;  // of the cube's edge: a slit is given in decimal, nodes are sums of binary doubles

template <class Triple>
std::string text(const Triple& v) {
  std::ostringstream out;
  out << '[' << v[0] << ", " << v[1] << ", " << v[2] << ']';
  return out.str();
}

std::string short_text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

void demand_valid(const RasterSource& source) {
  std::vector<Problem> problems;
  const auto refuse = [&](const std::string& key, const std::string& what, const std::string& allowed,
                          const std::string& given) {
    problems.push_back({"", 0, std::string(kName) + "." + key, what, allowed, given});
  };
  const auto positive = [](const std::array<int, 3>& v) { return v[0] >= 1 && v[1] >= 1 && v[2] >= 1; };
  if (!positive(source.cells)) refuse("cells", "needs at least one cell along each axis", ">= 1", text(source.cells));
  if (!positive(source.boxes)) refuse("boxes", "needs at least one box along each axis", ">= 1", text(source.boxes));
  if (!source.cell_size.allFinite() || source.cell_size.minCoeff() <= 0) {
    refuse("cell_size", "is no size", "finite, > 0", text(source.cell_size));
  }
  if (!source.gap.allFinite() || source.gap.minCoeff() < 0) {
    refuse("gap", "would make boxes overlap", "finite, >= 0", text(source.gap));
  }
  if (!source.origin.allFinite()) refuse("origin", "is no point", "finite", text(source.origin));
  if (source.single_tetrahedra && source.cells != std::array<int, 3>{1, 1, 1}) {
    refuse("cells", "a box of a single tetrahedron is one cell", "[1, 1, 1]", text(source.cells));
  }
  double elements = source.single_tetrahedra ? 1.0 : 24.0;
  for (int a = 0; a < 3; ++a) elements *= static_cast<double>(source.cells[at(a)]) * source.boxes[at(a)];
  constexpr Index kMostElements = std::numeric_limits<Index>::max() / 4;
  if (elements > static_cast<double>(kMostElements)) {
    refuse("cells", "makes too many tetrahedra", "up to " + std::to_string(kMostElements), short_text(elements));
  }
  if (source.slit) {
    const Vec3 extent = source.slit->upper - source.slit->lower;
    const auto zeros = std::count(extent.data(), extent.data() + 3, 0.0);
    if (!extent.allFinite() || extent.minCoeff() < 0 || zeros != 1) {
      refuse("slit", "is no plane rectangle along the axes", "lower <= upper, exactly one extent zero",
             text(source.slit->lower) + " to " + text(source.slit->upper));
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

/// Numbers of the nodes of one box, counted from the box's first node: cube corners, cube centres, face centres.
struct BoxNumbering {
  explicit BoxNumbering(const std::array<int, 3>& cells) : n(cells) {
    centres = (n[0] + 1) * (n[1] + 1) * (n[2] + 1);
    faces[0] = centres + n[0] * n[1] * n[2];
    faces[1] = faces[0] + (n[0] + 1) * n[1] * n[2];
    faces[2] = faces[1] + n[0] * (n[1] + 1) * n[2];
    total = faces[2] + n[0] * n[1] * (n[2] + 1);
  }
  [[nodiscard]] Index corner(int i, int j, int k) const { return i + (n[0] + 1) * (j + (n[1] + 1) * k); }
  [[nodiscard]] Index centre(int i, int j, int k) const { return centres + i + n[0] * (j + n[1] * k); }
  /// Centre of the lower face of cube (i, j, k) across `axis`; along it the index runs to n inclusive.
  [[nodiscard]] Index face(int axis, int i, int j, int k) const {
    const int nx = n[0] + (axis == 0 ? 1 : 0), ny = n[1] + (axis == 1 ? 1 : 0);
    return faces[at(axis)] + i + nx * (j + ny * k);
  }

  std::array<int, 3> n;
  Index centres = 0, total = 0;
  std::array<Index, 3> faces{};
};

class RasterBuilder {
 public:
  explicit RasterBuilder(const RasterSource& source) : source_(source), numbering_(source.cells) {
    mesh_.source = kName;
    mesh_.volume_groups = {source.group};
    mesh_.num_bodies = source.boxes[0] * source.boxes[1] * source.boxes[2];
    if (source.single_tetrahedra) return;
    for (const char* side : {".x0", ".x1", ".y0", ".y1", ".z0", ".z1"}) {
      mesh_.surface_groups.push_back(source.group + side);
    }
  }

  Mesh build() {
    Vec3 extent = source_.cell_size;
    for (int a = 0; a < 3; ++a) extent[a] *= source_.cells[at(a)];
    std::vector<Vec3> centres;
    Index body = 0;
    std::vector<std::size_t> first_nodes;
    for (int k = 0; k < source_.boxes[2]; ++k) {
      for (int j = 0; j < source_.boxes[1]; ++j) {
        for (int i = 0; i < source_.boxes[0]; ++i) {
          const Vec3 lower = source_.origin + Vec3(i, j, k).cwiseProduct(extent + source_.gap);
          first_nodes.push_back(mesh_.nodes.size());
          centres.push_back(lower + 0.5 * extent);
          if (source_.single_tetrahedra) {
            add_tetrahedron(centres.back(), body);
          } else {
            add_box(lower, body);
          }
          ++body;
        }
      }
    }
    first_nodes.push_back(mesh_.nodes.size());
    if (source_.slit) add_slit();
    if (source_.random_orientation) turn(centres, first_nodes);
    return std::move(mesh_);
  }

 private:
  void add_element(const std::array<Index, 4>& corners, Index body) {
    mesh_.element_source_id.push_back(static_cast<std::int64_t>(mesh_.elements.size()));
    mesh_.elements.push_back(corners);
    mesh_.element_group.push_back(0);
    mesh_.element_body.push_back(body);
  }

  void add_tetrahedron(const Vec3& centre, Index body) {
    const Index first = mesh_.num_nodes();
    const double half =
        source_.cell_size.x() / (2.0 * std::sqrt(2.0));  // of the cube whose face diagonals are the edges
    for (const Vec3& corner : {Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1), Vec3(-1, -1, 1)}) {
      mesh_.nodes.push_back(centre + half * corner);
    }
    add_element({first, first + 1, first + 2, first + 3}, body);
  }

  void add_box(const Vec3& lower, Index body) {
    const Index first = mesh_.num_nodes();
    mesh_.nodes.resize(mesh_.nodes.size() + static_cast<std::size_t>(numbering_.total));
    add_nodes(lower, first);
    for (int k = 0; k < source_.cells[2]; ++k) {
      for (int j = 0; j < source_.cells[1]; ++j) {
        for (int i = 0; i < source_.cells[0]; ++i) add_cube({i, j, k}, first, body);
      }
    }
  }

  void add_nodes(const Vec3& lower, Index first) {
    const auto& n = source_.cells;
    const auto place = [&](Index node, double i, double j, double k) {
      mesh_.nodes[at(first + node)] = lower + source_.cell_size.cwiseProduct(Vec3(i, j, k));
    };
    for (int k = 0; k <= n[2]; ++k) {
      for (int j = 0; j <= n[1]; ++j) {
        for (int i = 0; i <= n[0]; ++i) {
          place(numbering_.corner(i, j, k), i, j, k);
          const bool in_x = i < n[0], in_y = j < n[1], in_z = k < n[2];
          if (in_x && in_y && in_z) place(numbering_.centre(i, j, k), i + 0.5, j + 0.5, k + 0.5);
          if (in_y && in_z) place(numbering_.face(0, i, j, k), i, j + 0.5, k + 0.5);
          if (in_x && in_z) place(numbering_.face(1, i, j, k), i + 0.5, j, k + 0.5);
          if (in_x && in_y) place(numbering_.face(2, i, j, k), i + 0.5, j + 0.5, k);
        }
      }
    }
  }

  void add_cube(const std::array<int, 3>& cube, Index first, Index body) {
    const Index apex = first + numbering_.centre(cube[0], cube[1], cube[2]);
    for (int axis = 0; axis < 3; ++axis) {
      for (int upper = 0; upper < 2; ++upper) {
        std::array<int, 3> base = cube;
        base[at(axis)] += upper;
        const Index centre = first + numbering_.face(axis, base[0], base[1], base[2]);
        // The square's corners, counter-clockwise seen against `axis`: the two other axes in cyclic order.
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<Index, 4> ring{};
        for (int s = 0; s < 4; ++s) {
          std::array<int, 3> c = base;
          c[at(u)] += (s == 1 || s == 2) ? 1 : 0;
          c[at(v)] += (s >= 2) ? 1 : 0;
          ring[at(s)] = first + numbering_.corner(c[0], c[1], c[2]);
        }
        const bool on_side = base[at(axis)] == (upper == 0 ? 0 : source_.cells[at(axis)]);
        for (int s = 0; s < 4; ++s) {
          const Index p = ring[at(s)], q = ring[at((s + 1) % 4)];
          // (p, q, centre) turns about +axis; the apex must lie on the side its normal points to.
          add_element(upper == 0 ? std::array{p, q, centre, apex} : std::array{q, p, centre, apex}, body);
          if (on_side) mesh_.surface_faces.push_back({{p, q, centre}, 2 * axis + upper});
        }
      }
    }
  }

  void add_slit() {
    const auto group = static_cast<Index>(mesh_.surface_groups.size());
    mesh_.surface_groups.push_back(source_.group + ".slit");
    const Vec3 margin = kOnPlane * source_.cell_size;
    const Vec3 lower = source_.slit->lower - margin, upper = source_.slit->upper + margin;
    std::vector<char> inside(mesh_.nodes.size());
    for (std::size_t n = 0; n < inside.size(); ++n) {
      const Vec3& x = mesh_.nodes[n];
      inside[n] = ((x - lower).minCoeff() >= 0 && (upper - x).minCoeff() >= 0) ? 1 : 0;
    }
    const std::size_t before = mesh_.surface_faces.size();
    for (const auto& corners : mesh_.elements) {
      for (const auto& face : kFaceCorners) {
        const std::array<Index, 3> nodes{corners[at(face[0])], corners[at(face[1])], corners[at(face[2])]};
        if (std::all_of(nodes.begin(), nodes.end(), [&](Index node) { return inside[at(node)] != 0; })) {
          mesh_.surface_faces.push_back({nodes, group});
        }
      }
    }
    if (mesh_.surface_faces.size() == before) {
      throw InputError(Problem{"", 0, std::string(kName) + ".slit", "meets no face of the raster",
                               "a rectangle in a plane of element faces",
                               text(source_.slit->lower) + " to " + text(source_.slit->upper)});
    }
  }

  void turn(const std::vector<Vec3>& centres, const std::vector<std::size_t>& first_nodes) {
    for (std::size_t b = 0; b < centres.size(); ++b) {
      const Mat3 rotation = random_rotation(source_.seed, b);
      for (std::size_t n = first_nodes[b]; n < first_nodes[b + 1]; ++n) {
        mesh_.nodes[n] = centres[b] + rotation * (mesh_.nodes[n] - centres[b]);
      }
    }
  }

  const RasterSource& source_;
  BoxNumbering numbering_;
  Mesh mesh_;
};

}  // namespace

FinishedMesh make_raster(const RasterSource& source) {
  demand_valid(source);
  return finish_mesh(RasterBuilder(source).build(), {});
}

}  // namespace breccia
