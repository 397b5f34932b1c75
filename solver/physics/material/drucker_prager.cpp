#include "physics/material/drucker_prager.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "physics/material/drucker_prager_return.hpp"
#include "physics/material/exponential.hpp"

namespace breccia::material {
namespace {

namespace el = elasticity;
using Vector = std::array<double, 3>;
using Tensor = el::Tensor<double>;

constexpr std::array<std::array<std::size_t, 3>, 3> kPlace{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};  // in Symmetric

DruckerPragerMemory load(const double* memory) {
  DruckerPragerMemory m;
  std::memcpy(static_cast<void*>(&m), memory, sizeof m);
  return m;
}

Vector times(const Symmetric& a, const Vector& v) {
  Vector w{};
  for (std::size_t i = 0; i < 3; ++i) w[i] = a[kPlace[i][0]] * v[0] + a[kPlace[i][1]] * v[1] + a[kPlace[i][2]] * v[2];
  return w;
}

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A^T v
Vector transposed_times(const Tensor& a, const Vector& v) {
  Vector w{};
  for (std::size_t i = 0; i < 3; ++i) w[i] = a[i] * v[0] + a[3 + i] * v[1] + a[6 + i] * v[2];
  return w;
}

/// b - I = H + H^T + H H^T + F (G - I) F^T, H = F - I: small strains keep their digits.
Symmetric strain_tensor(const Tensor& f, const Symmetric& inverse_plastic) {
  Tensor h = f;
  for (const std::size_t diagonal : {0, 4, 8}) h[diagonal] -= 1.0;
  Symmetric b{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector row{f[3 * i], f[3 * i + 1], f[3 * i + 2]}, turned = times(inverse_plastic, row);
    for (std::size_t j = i; j < 3; ++j) {
      const Vector other{f[3 * j], f[3 * j + 1], f[3 * j + 2]};
      const double square = h[3 * i] * h[3 * j] + h[3 * i + 1] * h[3 * j + 1] + h[3 * i + 2] * h[3 * j + 2];
      b[kPlace[i][j]] = h[3 * i + j] + h[3 * j + i] + square + dot(turned, other);
    }
  }
  return b;
}

/// Elastic state at F when nothing flows.
struct Trial {
  Tensor f, cof;
  double j = 0;
  Principal b_minus_one;
  Vector square{};  ///< x_i
  Vector strain{};  ///< e_i
  Vector stress{};  ///< tau_i, Pa
};

Trial trial_of(const ElasticParams& p, const double* gradient, const DruckerPragerMemory& memory) {
  Trial t;
  std::copy_n(gradient, 9, t.f.begin());
  t.cof = el::cofactor(t.f);
  t.j = el::determinant(t.f, t.cof);
  t.b_minus_one = principal_of(strain_tensor(t.f, memory.inverse_plastic));
  constexpr double kLeast = 1e-12;  // for round-off: with J > j_min all are positive
  for (std::size_t i = 0; i < 3; ++i) {
    const double d = std::max(t.b_minus_one.value[i], kLeast - 1.0);
    t.square[i] = 1.0 + d;
    t.strain[i] = 0.5 * logarithm_1p(d);
  }
  const double volume = t.strain[0] + t.strain[1] + t.strain[2];
  for (std::size_t i = 0; i < 3; ++i) t.stress[i] = 2 * p.mu * t.strain[i] + p.lambda * volume;
  return t;
}

/// Plastic strains of a step by axis; the trial stress becomes the returned one.
ReturnedStress flow(const ElasticParams& p, const DruckerPragerMemory& memory, Trial& t, Vector& plastic) {
  const double mean = (t.stress[0] + t.stress[1] + t.stress[2]) / 3.0;
  const Vector deviator{t.stress[0] - mean, t.stress[1] - mean, t.stress[2] - mean};
  const double shear = std::sqrt(0.5 * dot(deviator, deviator));
  const double bulk = p.lambda + 2.0 / 3.0 * p.mu;
  const ReturnedStress r =
      return_stress(p.drucker_prager, p.mu, bulk, {mean, shear}, memory.plastic_shear, memory.compaction);
  if (!r.flows()) return r;
  const double kept = shear > 0 ? r.stress.shear / shear : 0.0;
  const double sheared = shear > 0 ? 0.5 * r.cone / shear : 0.0;
  const double volume = p.drucker_prager.dilation * r.cone - r.cap + r.cut;
  for (std::size_t i = 0; i < 3; ++i) {
    plastic[i] = sheared * deviator[i] + volume / 3.0;
    t.stress[i] = kept * deviator[i] + r.stress.mean;
  }
  return r;
}

/// F^T F - I, by H = F - I.
Symmetric deformation_of(const Tensor& f) {
  Tensor turned{};
  for (std::size_t i = 0; i < 9; ++i) turned[i] = f[i % 3 * 3 + i / 3];
  return strain_tensor(turned, {});
}

/// Takes the flow into the memory. @param plastic  its strains by axis;  @param elastic  tau_i without it, Pa
void remember_flow(const ElasticParams& p, const Trial& t, const Vector& elastic, const ReturnedStress& r,
                   const Vector& plastic, DruckerPragerMemory& memory) {
  const Symmetric now = deformation_of(t.f);
  Symmetric gone{};
  for (std::size_t k = 0; k < 6; ++k) gone[k] = memory.deformation[k] - now[k];
  std::array<Vector, 3> back{};  // F^-1 n_i
  Vector step{};                 // strains of the step: n . F^-T C_before F^-1 n = exp(-2 step)
  for (std::size_t i = 0; i < 3; ++i) {
    back[i] = transposed_times(t.cof, t.b_minus_one.axis[i]);
    for (double& component : back[i]) component /= t.j;
    step[i] = -0.5 * logarithm_1p(std::max(dot(back[i], times(gone, back[i])), p.j_min * p.j_min - 1.0));
  }
  double work = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double before = elastic[i] - 2 * p.mu * step[i] - p.lambda * (step[0] + step[1] + step[2]);
    work += 0.5 * (before + t.stress[i]) * plastic[i];
    const double change = t.square[i] * exponential_m1(-2.0 * plastic[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t l = k; l < 3; ++l) memory.inverse_plastic[kPlace[k][l]] += change * back[i][k] * back[i][l];
    }
  }
  memory.plastic_shear += r.cone;
  memory.compaction += r.cap;
  memory.plastic_work += std::max(0.0, work);
}

/// P = [sum tau_i / x_i n_i n_i^T] F G = tau F^-T.
Tensor first_piola(const Trial& t, const Symmetric& inverse_plastic) {
  Tensor left{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector& axis = t.b_minus_one.axis[i];
    const double factor = t.stress[i] / t.square[i];
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t l = 0; l < 3; ++l) left[3 * k + l] += factor * axis[k] * axis[l];
    }
  }
  Tensor piola = el::product(left, t.f);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector row{piola[3 * k], piola[3 * k + 1], piola[3 * k + 2]}, turned = times(inverse_plastic, row);
    for (std::size_t l = 0; l < 3; ++l) piola[3 * k + l] += turned[l];
  }
  return piola;
}

double energy_of(const ElasticParams& p, const Trial& t) {
  const double volume = t.strain[0] + t.strain[1] + t.strain[2];
  return p.mu * dot(t.strain, t.strain) + 0.5 * p.lambda * volume * volume;
}

/// A crushed element: the state of its last step above, and where it is now.
struct Crushed {
  Tensor stress{};    ///< S_0, Pa
  double energy = 0;  ///< W_0, J/m3
  double below = 0;   ///< J - j_min <= 0
  double curvature = 0;
};

/// Evaluates the last step at F = sqrt(C_0): the stress S does not feel the rotation.
Crushed crushed_of(const ElasticParams& p, double j, const DruckerPragerMemory& memory) {
  const Principal c = principal_of(memory.deformation);
  Tensor root{}, inverse{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double stretch = std::sqrt(1.0 + c.value[i]);
    for (std::size_t k = 0; k < 9; ++k) {
      const double product = c.axis[i][k / 3] * c.axis[i][k % 3];
      root[k] += stretch * product;
      inverse[k] += product / stretch;
    }
  }
  const Trial t = trial_of(p, root.data(), memory);
  return {el::product(inverse, first_piola(t, memory.inverse_plastic)), energy_of(p, t), j - p.j_min,
          el::volumetric_curvature(p.j_min, p)};
}

}  // namespace

void drucker_prager_piola(const ElasticParams& p, const double* f, double* memory, double* piola) {
  DruckerPragerMemory m = load(memory);
  Trial t = trial_of(p, f, m);
  if (!(t.j > p.j_min)) {
    const Crushed crushed = crushed_of(p, t.j, m);
    const Tensor result = el::product(t.f, crushed.stress);
    for (std::size_t i = 0; i < 9; ++i) piola[i] = result[i] + crushed.curvature * crushed.below * t.cof[i];
    return;
  }
  const Symmetric before = m.inverse_plastic;  // with which the axes and the x_i were found
  const Vector elastic = t.stress;
  Vector plastic{};
  const ReturnedStress r = flow(p, m, t, plastic);
  if (r.flows()) remember_flow(p, t, elastic, r, plastic, m);
  const Tensor result = first_piola(t, before);
  std::copy(result.begin(), result.end(), piola);
  m.deformation = deformation_of(t.f);
  std::memcpy(memory, &m, sizeof m);
}

double drucker_prager_energy(const ElasticParams& p, const double* f, const double* memory) {
  const DruckerPragerMemory m = load(memory);
  const Trial t = trial_of(p, f, m);
  if (t.j > p.j_min) return energy_of(p, t);
  const Crushed crushed = crushed_of(p, t.j, m);
  const Symmetric now = deformation_of(t.f);
  double work = 0;
  for (std::size_t k = 0; k < 9; ++k) {
    const std::size_t place = kPlace[k / 3][k % 3];
    work += 0.5 * crushed.stress[k] * (now[place] - m.deformation[place]);
  }
  return crushed.energy + work + 0.5 * crushed.curvature * crushed.below * crushed.below;
}

namespace {

/// What the bound adds up over the four gradients: a |F^-T g|^2 + b g . G g + c |cof F g|^2 + d |g|^2.
struct Moduli {
  double pushed = 0, plastic = 0, turned = 0, plain = 0;
};

Moduli moduli_of(const ElasticParams& p, const Trial& t, const DruckerPragerMemory& memory) {
  Moduli moduli;
  if (t.j > p.j_min) {
    const auto [least, most] = std::minmax_element(t.square.begin(), t.square.end());
    moduli.pushed = p.lambda + 2.0 * p.mu * std::sqrt(*most / *least);
    for (std::size_t i = 0; i < 3; ++i) moduli.plastic = std::max(moduli.plastic, std::abs(t.stress[i]) / t.square[i]);
    return moduli;
  }
  const Crushed crushed = crushed_of(p, t.j, memory);
  double stress = 0, size = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    stress += crushed.stress[i] * crushed.stress[i];
    size += t.f[i] * t.f[i];
  }
  moduli.turned = crushed.curvature;
  moduli.plain = std::sqrt(stress) - crushed.curvature * crushed.below * std::sqrt(size);
  return moduli;
}

}  // namespace

double drucker_prager_stiffness(const ElasticParams& p, const double* f, const double* memory, const double* gradient) {
  const DruckerPragerMemory m = load(memory);
  const Trial t = trial_of(p, f, m);
  const Moduli moduli = moduli_of(p, t, m);
  double sum = 0;
  for (std::size_t a = 0; a < 4; ++a) {
    Vector g{};
    for (std::size_t i = 0; i < 3; ++i)
      g[i] = a < 3 ? gradient[3 * a + i] : -(gradient[i] + gradient[3 + i] + gradient[6 + i]);
    Vector plastic = times(m.inverse_plastic, g), turned{};
    for (std::size_t i = 0; i < 3; ++i) {
      plastic[i] += g[i];
      turned[i] = t.cof[3 * i] * g[0] + t.cof[3 * i + 1] * g[1] + t.cof[3 * i + 2] * g[2];
    }
    const double square = dot(turned, turned);
    const double pushed = t.j > p.j_min ? square / (t.j * t.j) : 0.0;
    sum +=
        moduli.pushed * pushed + moduli.plastic * dot(g, plastic) + moduli.turned * square + moduli.plain * dot(g, g);
  }
  return sum;
}

}  // namespace breccia::material
