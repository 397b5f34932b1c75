#include "brecciaFragmentTable.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "vtkMath.h"

namespace breccia {
namespace {

using Vec = std::array<double, 3>;
__extension__ using Wide = __int128;

std::size_t At(vtkIdType i) { return static_cast<std::size_t>(i); }

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Sums of `Width` kinds of numbers by fragment, exact but for the rounding of each term. A term that is not finite
/// makes its sum no number, and no other one.
template <std::size_t Width>
class Sums {
 public:
  using Terms = std::array<double, Width>;

  /// @param of  calls its argument with (fragment, terms) for every term; called twice
  template <class Each>
  Sums(const std::vector<vtkTypeInt64>& ids, const Ranks& ranks, Each&& of) {
    std::vector<double> largest(Width, 0.0);
    of([&](std::size_t, const Terms& terms) {
      for (std::size_t k = 0; k < Width; ++k) {
        if (std::isfinite(terms[k])) largest[k] = std::max(largest[k], std::abs(terms[k]));
      }
    });
    ranks.Largest(largest);
    for (std::size_t k = 0; k < Width; ++k) exponent_[k] = largest[k] > 0 ? 90 - std::ilogb(largest[k]) : 0;
    std::vector<Row> rows(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) rows[i].id = ids[i];
    of([&](std::size_t fragment, const Terms& terms) {
      for (std::size_t k = 0; k < Width; ++k) {
        if (std::isfinite(terms[k])) {
          rows[fragment].sum[k] += static_cast<Wide>(std::ldexp(terms[k], exponent_[k]));
        } else {
          rows[fragment].not_finite |= 1U << k;
        }
      }
    });
    rows_ = ranks.Gather(rows);
    std::sort(rows_.begin(), rows_.end(), [](const Row& p, const Row& q) { return p.id < q.id; });
    std::size_t last = 0;
    for (std::size_t i = 1; i < rows_.size(); ++i) {
      if (rows_[i].id == rows_[last].id) {
        for (std::size_t k = 0; k < Width; ++k) rows_[last].sum[k] += rows_[i].sum[k];
        rows_[last].not_finite |= rows_[i].not_finite;
      } else {
        rows_[++last] = rows_[i];
      }
    }
    if (!rows_.empty()) rows_.resize(last + 1);
  }
  std::size_t Count() const { return rows_.size(); }
  vtkTypeInt64 Id(std::size_t row) const { return rows_[row].id; }
  Terms Of(std::size_t row) const {
    Terms terms;
    for (std::size_t k = 0; k < Width; ++k) {
      const bool finite = (rows_[row].not_finite >> k & 1U) == 0;
      terms[k] = finite ? std::ldexp(static_cast<double>(rows_[row].sum[k]), -exponent_[k]) : kNone;
    }
    return terms;
  }

 private:
  struct Row {
    vtkTypeInt64 id = 0;
    std::array<Wide, Width> sum{};
    std::uint32_t not_finite = 0;  ///< bit k: of sum k
  };
  static_assert(Width <= 32);
  std::array<int, Width> exponent_{};
  std::vector<Row> rows_;
};

Vec Minus(const double* a, const double* b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec Cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double Dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Shape of one element.
struct Tetra {
  Vec centroid;
  double volume, open_area;
  vtkTypeInt64 cracked;
};

/// Eigenvalues, largest first, and unit eigenvectors (rows) of the symmetric matrix xx yy zz xy yz xz.
void Eigen(const std::array<double, 6>& m, Vec& values, std::array<Vec, 3>& vectors) {
  if (!std::all_of(m.begin(), m.end(), [](double x) { return std::isfinite(x); })) {
    values.fill(kNone);
    vectors.fill(values);
    return;
  }
  double a[3][3] = {{m[0], m[3], m[5]}, {m[3], m[1], m[4]}, {m[5], m[4], m[2]}}, v[3][3];
  double *rows[3] = {a[0], a[1], a[2]}, *columns[3] = {v[0], v[1], v[2]};
  vtkMath::Jacobi(rows, values.data(), columns);
  for (std::size_t k = 0; k < 3; ++k) vectors[k] = {v[0][k], v[1][k], v[2][k]};
}

/// w of I w = l, without what belongs to eigenvalues that are round-off.
Vec Spin(const std::array<double, 6>& inertia, const Vec& l) {
  Vec values, w{};
  std::array<Vec, 3> axes;
  Eigen(inertia, values, axes);
  constexpr double kRoundOff = 1e-10;  // relative: positions come in doubles, differences lose a few digits
  for (std::size_t k = 0; k < 3; ++k) {
    if (values[k] <= kRoundOff * values[0]) continue;
    const double rate = Dot(axes[k], l) / values[k];
    for (std::size_t i = 0; i < 3; ++i) w[i] += rate * axes[k][i];
  }
  return w;
}

class Tabulator {
 public:
  Tabulator(const Elements& elements, const Connectivity& connectivity, const std::vector<double>& mass,
            const std::vector<double>& velocity, const Ranks& ranks)
      : elements_(elements), connectivity_(connectivity), mass_(mass), velocity_(velocity), ranks_(ranks) {
    ids_ = connectivity.fragment;
    std::sort(ids_.begin(), ids_.end());
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
    const IdIndex here(ids_);
    for (const vtkTypeInt64 id : connectivity.fragment) local_.push_back(At(here.Find(id)));
    for (vtkIdType e = 0; e < elements.Count(); ++e) tetras_.push_back(TetraOf(e));
  }

  std::vector<Fragment> Run() {
    SumMasses();
    SumMoments();
    Bound();
    return std::move(fragments_);
  }

 private:
  const double* Corner(vtkIdType e, int c) const { return &elements_.corners[At(12 * e + 3 * c)]; }

  Tetra TetraOf(vtkIdType e) const {
    Tetra t{{0, 0, 0}, 0, 0, 0};
    for (int c = 0; c < 4; ++c) {
      for (int k = 0; k < 3; ++k) t.centroid[At(k)] += 0.25 * Corner(e, c)[k];
    }
    t.volume = std::abs(Dot(Cross(Minus(Corner(e, 1), Corner(e, 0)), Minus(Corner(e, 2), Corner(e, 0))),
                            Minus(Corner(e, 3), Corner(e, 0)))) /
               6;
    for (int f = 0; f < 4; ++f) {
      const unsigned char face = connectivity_.face[At(4 * e + f)];
      if (face == Connectivity::held) continue;
      const int* c = kFaceCorners[f];
      const Vec n = Cross(Minus(Corner(e, c[1]), Corner(e, c[0])), Minus(Corner(e, c[2]), Corner(e, c[0])));
      t.open_area += 0.5 * std::sqrt(Dot(n, n));
      if (face == Connectivity::cracked) ++t.cracked;
    }
    return t;
  }

  void SumMasses() {
    const Sums<11> sums(ids_, ranks_, [&](auto&& add) {
      for (std::size_t e = 0; e < tetras_.size(); ++e) {
        const Tetra& t = tetras_[e];
        const double m = mass_[e], *v = &velocity_[3 * e];
        add(local_[e], {m, t.volume, t.open_area, 1, static_cast<double>(t.cracked), m * t.centroid[0],
                        m * t.centroid[1], m * t.centroid[2], m * v[0], m * v[1], m * v[2]});
      }
    });
    for (std::size_t i = 0; i < sums.Count(); ++i) {
      const auto s = sums.Of(i);
      Fragment f;
      f.id = sums.Id(i);
      f.mass = s[0];
      f.volume = s[1];
      f.area = s[2];
      f.elements = std::llround(s[3]);
      f.cracked = std::llround(s[4]);
      for (std::size_t k = 0; k < 3; ++k) {
        f.centroid[k] = f.mass > 0 ? s[5 + k] / f.mass : 0 * f.mass;
        f.velocity[k] = f.mass > 0 ? s[8 + k] / f.mass : 0 * f.mass;
      }
      fragments_.push_back(f);
    }
    const IdIndex all(IdsOfAll());
    for (const vtkTypeInt64 id : ids_) global_.push_back(At(all.Find(id)));
  }

  std::vector<vtkTypeInt64> IdsOfAll() const {
    std::vector<vtkTypeInt64> ids;
    for (const Fragment& f : fragments_) ids.push_back(f.id);
    return ids;
  }

  /// About the centroids: inertia and angular momentum of the elements' centroids, second moments of the volume.
  void SumMoments() {
    const Sums<15> sums(ids_, ranks_, [&](auto&& add) {
      for (std::size_t e = 0; e < tetras_.size(); ++e) {
        const Fragment& f = fragments_[global_[local_[e]]];
        const Vec r = Minus(tetras_[e].centroid.data(), f.centroid.data());
        const Vec l = Cross(r, Minus(&velocity_[3 * e], f.velocity.data()));
        const double m = mass_[e];
        const auto s = SecondMoments(static_cast<vtkIdType>(e), f.centroid);
        add(local_[e], {m * (r[1] * r[1] + r[2] * r[2]), m * (r[0] * r[0] + r[2] * r[2]),
                        m * (r[0] * r[0] + r[1] * r[1]), -m * r[0] * r[1], -m * r[1] * r[2], -m * r[0] * r[2], m * l[0],
                        m * l[1], m * l[2], s[0], s[1], s[2], s[3], s[4], s[5]});
      }
    });
    for (std::size_t i = 0; i < fragments_.size(); ++i) {
      const auto s = sums.Of(i);
      Fragment& f = fragments_[i];
      f.spin = Spin({s[0], s[1], s[2], s[3], s[4], s[5]}, {s[6], s[7], s[8]});
      Vec values;
      Eigen({s[9], s[10], s[11], s[12], s[13], s[14]}, values, f.axes);
      for (std::size_t k = 0; k < 3; ++k)
        f.semi_axes[k] = f.volume > 0 ? std::sqrt(5 * (values[k] < 0 ? 0.0 : values[k]) / f.volume) : 0 * f.volume;
    }
  }

  /// Integral of x x over an element, V/20 (sum of p p + (sum of p)(sum of p)) of its corners p: xx yy zz xy yz xz.
  std::array<double, 6> SecondMoments(vtkIdType e, const Vec& about) const {
    std::array<Vec, 4> p;
    Vec sum{};
    for (int c = 0; c < 4; ++c) {
      p[At(c)] = Minus(Corner(e, c), about.data());
      for (std::size_t k = 0; k < 3; ++k) sum[k] += p[At(c)][k];
    }
    constexpr int kPairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
    std::array<double, 6> moments{};
    for (std::size_t m = 0; m < 6; ++m) {
      const auto i = At(kPairs[m][0]), j = At(kPairs[m][1]);
      double products = sum[i] * sum[j];
      for (const Vec& x : p) products += x[i] * x[j];
      moments[m] = tetras_[At(e)].volume / 20 * products;
    }
    return moments;
  }

  void Bound() {
    std::vector<double> largest(fragments_.size(), 0.0);
    for (vtkIdType e = 0; e < elements_.Count(); ++e) {
      const std::size_t row = global_[local_[At(e)]];
      const Fragment& f = fragments_[row];
      if (!(f.semi_axes[2] > 0)) continue;
      for (int c = 0; c < 4; ++c) {
        const Vec p = Minus(Corner(e, c), f.centroid.data());
        double share = 0;
        for (std::size_t k = 0; k < 3; ++k) share += std::pow(Dot(p, f.axes[k]) / f.semi_axes[k], 2);
        largest[row] = std::max(largest[row], share);
      }
    }
    ranks_.Largest(largest);
    for (std::size_t i = 0; i < fragments_.size(); ++i) fragments_[i].bounding_factor = std::sqrt(largest[i]);
  }

  const Elements& elements_;
  const Connectivity& connectivity_;
  const std::vector<double>&mass_, &velocity_;
  const Ranks& ranks_;
  std::vector<vtkTypeInt64> ids_;    ///< of this rank's fragments, ascending
  std::vector<std::size_t> local_;   ///< (elements) row of ids_
  std::vector<std::size_t> global_;  ///< (ids_) row of fragments_
  std::vector<Tetra> tetras_;
  std::vector<Fragment> fragments_;
};

}  // namespace

double Fragment::Diameter() const { return std::cbrt(6 * volume / vtkMath::Pi()); }
double Fragment::SieveSize() const { return 2 * semi_axes[1]; }
double Fragment::Sphericity() const { return area > 0 ? vtkMath::Pi() * Diameter() * Diameter() / area : 0; }

std::vector<Fragment> Tabulate(const Elements& elements, const Connectivity& connectivity, const Ranks& ranks) {
  std::vector<double> mass, velocity;
  std::string problem;
  try {
    mass = Numbers(elements.grid, "mass");
    velocity = Numbers(elements.grid, "velocity", 3);
  } catch (const BadInput& bad) {
    problem = std::string("elements: ") + bad.what();
  }
  ranks.Agree(problem);
  return Tabulator(elements, connectivity, mass, velocity, ranks).Run();
}

}  // namespace breccia
