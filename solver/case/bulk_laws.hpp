#pragma once

#include <cmath>
#include <string>
#include <utility>

namespace breccia::case_ {

// The bulk laws of a case, each with the keys that belong to it alone: what they are, how they are read and written,
// and what must hold between them. Their help and ranges: case/schema_keys.cpp.

enum class BulkLaw { neo_hookean, green_st_venant, drucker_prager };

/// Strength and flow of a material whose law is drucker_prager.
struct DruckerPrager {
  double friction_angle = 0;  ///< rad
  double dilation_angle = 0;  ///< rad
  double cohesion = 0;        ///< Pa
  double hardening = 0;       ///< Pa, cohesion gained a unit of plastic shear
  double tension_cutoff = 0;  ///< Pa, largest mean stress; 0: the apex of the cone
  double cap_pressure = 0;    ///< Pa; 0: no cap
  double cap_hardening = 0;   ///< Pa, cap pressure gained a unit of compaction
  friend bool operator==(const DruckerPrager&, const DruckerPrager&) = default;
};

/// Of a material with another law they are read, to be refused with their names, but not written.
template <class A>
void bind(A& a, BulkLaw law, DruckerPrager& keys) {
  if (!A::reads && law != BulkLaw::drucker_prager) return;
  a.value("friction_angle", keys.friction_angle);
  a.value("dilation_angle", keys.dilation_angle);
  a.value("cohesion", keys.cohesion);
  a.value("hardening", keys.hardening);
  a.value("tension_cutoff", keys.tension_cutoff);
  a.value("cap_pressure", keys.cap_pressure);
  a.value("cap_hardening", keys.cap_hardening);
}

/// Calls problem(key, what is wrong, what is allowed, what was given) for each rule that is broken.
template <class Report>
void validate(BulkLaw law, const DruckerPrager& p, Report&& problem) {
  if (law != BulkLaw::drucker_prager) {
    for (const auto& [name, value] : {std::pair{"friction_angle", p.friction_angle},
                                      {"dilation_angle", p.dilation_angle},
                                      {"cohesion", p.cohesion},
                                      {"hardening", p.hardening},
                                      {"tension_cutoff", p.tension_cutoff},
                                      {"cap_pressure", p.cap_pressure},
                                      {"cap_hardening", p.cap_hardening}})
      if (value != 0)
        problem(name, "belongs to a law that this material does not have", "law = \"drucker_prager\"", "");
    return;
  }
  if (p.cohesion == 0 && p.friction_angle == 0)
    problem("cohesion", "the material has no strength", "cohesion > 0, or friction_angle > 0", "");
  if (p.dilation_angle > p.friction_angle)
    problem("dilation_angle", "is above the friction angle: flow would give energy",
            "at most friction_angle, " + std::to_string(p.friction_angle) + " rad", std::to_string(p.dilation_angle));
  const double apex = p.cohesion / std::tan(p.friction_angle);
  if (p.friction_angle > 0 && p.tension_cutoff > apex)
    problem("tension_cutoff", "lies beyond the tip of the cone",
            "at most cohesion / tan(friction_angle), " + std::to_string(apex) + " Pa, or \"apex\"",
            std::to_string(p.tension_cutoff));
  if (p.cap_hardening > 0 && p.cap_pressure == 0)
    problem("cap_hardening", "hardens a cap that is not there", "with a cap_pressure", "");
}

}  // namespace breccia::case_
