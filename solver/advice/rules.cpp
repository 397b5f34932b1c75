#include <array>
#include <type_traits>

#include "advice/advice.hpp"

namespace breccia {
namespace {

Sentences sentences(Sentences all) { return all; }
Sentences sentences(std::string one) {
  Sentences all;
  add_to(all, std::move(one));
  return all;
}

/// A rule from a function of rule_functions.hpp: passes the arguments that the function takes.
template <auto kFunction>
Sentences by(const Subject& subject) {
  using F = decltype(kFunction);
  if constexpr (std::is_invocable_v<F, const Model&>)
    return sentences(kFunction(subject.model()));
  else if constexpr (std::is_invocable_v<F, const case_::Case&>)
    return sentences(kFunction(subject.input()));
  else if constexpr (std::is_invocable_v<F, const case_::Case&, const Model&>)
    return sentences(kFunction(subject.input(), subject.model()));
  else if constexpr (std::is_invocable_v<F, const Model&, const AllJointMeasures&>)
    return sentences(kFunction(subject.model(), subject.joints()));
  else if constexpr (std::is_invocable_v<F, const Model&, const AllJointMeasures&, double>)
    return sentences(kFunction(subject.model(), subject.joints(), subject.step().dt()));
  else if constexpr (std::is_invocable_v<F, const StepAtStart&>)
    return sentences(kFunction(subject.step()));
  else if constexpr (std::is_invocable_v<F, const Model&, const StepAtStart&>)
    return sentences(kFunction(subject.model(), subject.step()));
  else if constexpr (std::is_invocable_v<F, const case_::Case&, const StepAtStart&>)
    return sentences(kFunction(subject.input(), subject.step()));
  else if constexpr (std::is_invocable_v<F, const case_::Case&, const Model&, const StepAtStart&>)
    return sentences(kFunction(subject.input(), subject.model(), subject.step()));
  else if constexpr (std::is_invocable_v<F, const case_::Case&, const Mesh&, const Topology&>)
    return sentences(kFunction(subject.input(), subject.model().mesh, subject.model().topology));
  else if constexpr (std::is_invocable_v<F, const FramesEstimate&>)
    return sentences(kFunction(subject.frames()));
  else
    return sentences(kFunction(subject.input(), subject.model(), subject.overlaps()));
}

using enum Level;
constexpr bool kCheck = false, kRun = true;  // at_start: reported by `check` alone, by `run` as well

// clang-format off
constexpr std::array kRules{  // sorted by level
    // The run is not what the case intends.
    Rule{"overlapping_bodies",       wrong,      "contact[].initial_overlap",kCheck, by<overlapping_bodies>},
    Rule{"elements_left_out",        wrong,      "mesh.file",               kRun,   by<elements_left_out>},
    Rule{"unjoined_volumes",         wrong,      "mesh.glue",               kRun,   by<unjoined_volumes>},
    Rule{"bodies_without_contact",   wrong,      "contact[]",               kCheck, by<bodies_without_contact>},
    Rule{"fragments_without_contact",wrong,      "contact[]",               kCheck, by<fragments_without_contact>},
    Rule{"no_contact_points",        wrong,      "contact_points.surfaces", kRun,   by<no_contact_points>},
    Rule{"soft_penalty",             wrong,      "contact[].penalty",       kRun,   by<soft_penalty>},
    Rule{"empty_sphere",             wrong,      "sphere.radius",           kRun,   by<empty_sphere>},
    Rule{"small_sphere",             wrong,      "sphere.radius",           kCheck, by<small_sphere>},
    Rule{"step_too_long",            wrong,      "time.step",               kCheck, by<step_too_long>},
    Rule{"part_in_motion",           wrong,      "initial_velocity[]",      kRun,   by<part_in_motion>},
    Rule{"lost_velocity",            wrong,      "initial_velocity[]",      kRun,   by<lost_velocity>},
    Rule{"load_on_held_nodes",       wrong,      "stage[].constraint[]",    kRun,   by<load_on_held_nodes>},
    Rule{"load_within_the_model",    wrong,      "stage[].pressure[]",      kRun,   by<load_within_the_model>},
    Rule{"overruled_constraint",     wrong,      "stage[].constraint[]",    kRun,   by<overruled_constraint>},
    Rule{"unused_joint_law",         wrong,      "joint[].between",         kRun,   by<unused_joint_law>},
    Rule{"tied_contacts",            wrong,      "contact[].between",       kRun,   by<tied_contacts>},
    // Probable input errors.
    Rule{"unit_of_lengths",          doubtful,   "mesh.scale",              kCheck, by<unit_of_lengths>},
    Rule{"implausible_material",     doubtful,   "material[].density",      kCheck, by<implausible_material>},
    Rule{"implausible_strength",     doubtful,   "joint[].tensile_strength",kCheck, by<implausible_strength>},
    Rule{"implausible_friction",     doubtful,   "contact[].friction",      kCheck, by<implausible_friction>},
    Rule{"function_cut_off",         doubtful,   "stage[].end",             kCheck, by<function_cut_off>},
    Rule{"not_repeated_in_stage",    doubtful,   "stage[].constraint[]",    kCheck, by<not_repeated_in_stage>},
    Rule{"absorbing_under_gravity",  doubtful,   "stage[].absorbing",       kCheck, by<absorbing_under_gravity>},
    Rule{"data_file_times",          doubtful,   "stage[]",                 kCheck, by<data_file_times>},
    Rule{"lowered_penalty",          doubtful,   "contact[].penalty",       kRun,   by<lowered_penalty>},
    Rule{"slice_without_plane",      doubtful,   "plane.kind",              kCheck, by<slice_without_plane>},
    Rule{"pressed_without_friction", doubtful,   "contact[].friction",      kRun,   by<pressed_without_friction>},
    Rule{"long_interval",            doubtful,   "output.frame_interval",   kCheck, by<long_interval>},
    // Accuracy.
    Rule{"sudden_load",              inaccurate, "stage[].local_damping",   kCheck, by<sudden_load>},
    Rule{"sudden_motion",            inaccurate, "stage[].constraint[]",    kCheck, by<sudden_motion>},
    Rule{"coarse_for_process_zone",  inaccurate, "mesh.file",               kCheck, by<coarse_for_process_zone>},
    Rule{"soft_joints",              inaccurate, "joint[].penalty",         kCheck, by<soft_joints>},
    Rule{"stiff_bending",            inaccurate, "mesh.file",               kCheck, by<stiff_bending>},
    Rule{"undamped_friction",        inaccurate, "material[].viscosity",    kCheck, by<undamped_friction>},
    Rule{"damped_sliding",           inaccurate, "stage[].local_damping",   kCheck, by<damped_sliding>},
    Rule{"damped_reactions",         inaccurate, "stage[].local_damping",   kCheck, by<damped_reactions>},
    Rule{"sudden_softening",         inaccurate, "time.safety",             kCheck, by<sudden_softening>},
    Rule{"late_contact",             inaccurate, "contact_points.per_face", kCheck, by<late_contact>},
    Rule{"coarse_contact_points",    inaccurate, "contact_points.per_face", kCheck, by<coarse_contact_points>},
    Rule{"raster_planes",            inaccurate, "mesh.raster",             kCheck, by<raster_planes>},
    Rule{"slender_layer",            inaccurate, "plane",                   kCheck, by<slender_layer>},
    // Cost.
    Rule{"step_of_contact",          costly,     "contact[].penalty",       kCheck, by<step_of_contact>},
    Rule{"step_of_viscosity",        costly,     "material[].viscosity",    kCheck, by<step_of_viscosity>},
    Rule{"one_bad_element",          costly,     "mesh.file",               kCheck, by<one_bad_element>},
    Rule{"slivers",                  costly,     "mesh.file",               kCheck, by<slivers>},
    Rule{"many_frames",              costly,     "output.frame_interval",   kCheck, by<many_frames>},
};
// clang-format on

}  // namespace

const char* name_of(Level level) {
  switch (level) {
    case Level::wrong:
      return "wrong";
    case Level::doubtful:
      return "doubtful";
    case Level::inaccurate:
      return "inaccurate";
    case Level::costly:
      break;
  }
  return "costly";
}

std::span<const Rule> rules() { return kRules; }

std::vector<Advice> advise(const Subject& subject) {
  std::vector<Advice> advice;
  for (const Rule& rule : kRules) {
    for (std::string& text : rule.find(subject)) advice.push_back({&rule, std::move(text)});
  }
  return advice;
}

Sentences start_warnings(const case_::Case& input, const Model& model) {
  const Subject subject(input, model);
  Sentences warnings;
  for (const Rule& rule : kRules) {
    if (rule.at_start) append(warnings, rule.find(subject));
  }
  return warnings;
}

}  // namespace breccia
