#pragma once

#include <array>

#include "output/frames/frame.hpp"

namespace breccia {

/// One term of the energy budget: its name in files, and in words.
struct EnergyTerm {
  const char* name;   ///< as the member of EnergyBudget
  const char* words;  ///< for people
  double EnergyBudget::*value;
};

/// Every term in J, in the order in which files and the terminal list them (residual_relative is not a term).
inline constexpr std::array<EnergyTerm, 15> kEnergyTerms{{
    {"kinetic", "kinetic", &EnergyBudget::kinetic},
    {"elastic", "elastic", &EnergyBudget::elastic},
    {"joint_elastic", "stored in joints", &EnergyBudget::joint_elastic},
    {"contact_stored", "stored in contacts", &EnergyBudget::contact_stored},
    {"joint_mode_1", "fracture, mode I", &EnergyBudget::joint_mode_1},
    {"joint_mode_2", "fracture, mode II", &EnergyBudget::joint_mode_2},
    {"joint_friction", "friction in joints", &EnergyBudget::joint_friction},
    {"contact_dissipated", "contact, inelastic", &EnergyBudget::contact_dissipated},
    {"contact_friction", "contact, friction", &EnergyBudget::contact_friction},
    {"plastic", "plastic work", &EnergyBudget::plastic},
    {"viscous", "viscous", &EnergyBudget::viscous},
    {"damping", "damping", &EnergyBudget::damping},
    {"external_work", "external work", &EnergyBudget::external_work},
    {"step_change", "moved by changes of the step", &EnergyBudget::step_change},
    {"residual", "residual, unaccounted", &EnergyBudget::residual},
}};

}  // namespace breccia
