#pragma once

#include <cmath>

#include "case/case.hpp"

/// Which key of the schema stands for which member of a case: written once, walked by the reader and by the writer.
/// An archive A offers: A::reads; value(key, member); choice(key, enumeration); axis_functions(key, axes, values);
/// section(key, visitor), optional_section(key, member), list(key, members); origin(member) and, to read only:
/// has(key), exactly_one(keys), at_most_one(keys), needed(keys),
/// only(keys, condition), smallest_young(groups), resolve_script(name).
namespace breccia::case_ {

template <class A>
void bind(A& a, Raster::Slit& slit) {
  a.value("lower", slit.lower);
  a.value("upper", slit.upper);
}

template <class A>
void bind(A& a, Raster& raster) {
  a.choice("kind", raster.single_tetrahedra);
  a.value("cells", raster.cells);
  a.value("cell_size", raster.cell_size);
  a.value("boxes", raster.boxes);
  a.value("gap", raster.gap);
  a.value("origin", raster.origin);
  a.value("group", raster.group);
  a.value("random_orientation", raster.random_orientation);
  a.value("seed", raster.seed);
  a.optional_section("slit", raster.slit);
}

template <class A>
void bind(A& a, Start& start) {
  a.origin(start.origin);
  a.value("from", start.from);
  if constexpr (A::reads) a.at_most_one({"at", "step"});
  if (A::reads || start.step == 0) a.value("at", start.at);
  if (A::reads || start.step > 0) a.value("step", start.step);
}

template <class A>
void bind(A& a, MeshSource& mesh) {
  a.origin(mesh.origin);
  if constexpr (A::reads) a.exactly_one({"file", "raster"});
  if (A::reads || !mesh.file.empty()) a.value("file", mesh.file);
  a.value("parameters", mesh.parameters);
  a.value("scale", mesh.scale);
  a.value("size", mesh.size);
  a.value("glue", mesh.glue);
  a.value("merge_nodes", mesh.merge_nodes);
  a.choice("inverted", mesh.repair_inverted);
  a.value("time_limit", mesh.time_limit);
  a.value("memory_limit", mesh.memory_limit);
  a.optional_section("raster", mesh.raster);
}

template <class A>
void bind(A& a, Plane& plane) {
  a.origin(plane.origin);
  a.choice("kind", plane.kind);
  a.choice("axis", plane.axis);
}

template <class A>
void bind(A& a, Material& material) {
  a.origin(material.origin);
  a.value("group", material.group);
  a.choice("law", material.law);
  a.value("young", material.young);
  a.value("poisson", material.poisson);
  a.value("density", material.density);
  a.value("viscosity", material.viscosity);
  bind(a, material.law, material.plasticity);
  a.choice("joints", material.joints);
}

/// The penalty of a joint or a contact, in Pa or as a multiple of Young's modulus; the factor is kept where the groups
/// are any, since it depends on the pair.
template <class A, class Entry>
void bind_penalty(A& a, Entry& entry) {
  if constexpr (A::reads) {
    a.at_most_one({"penalty", "penalty_factor"});
    if (a.has("penalty")) return a.value("penalty", entry.penalty);
    double factor = 0;
    a.value("penalty_factor", factor);
    const bool of_any = entry.groups[0] == every_group || entry.groups[1] == every_group;
    (of_any ? entry.penalty_factor : entry.penalty) = of_any ? factor : factor * a.smallest_young(entry.groups);
  } else if (entry.penalty_factor > 0) {
    a.value("penalty_factor", entry.penalty_factor);
  } else {
    a.value("penalty", entry.penalty);
  }
}

/// The keys of a joint of which one or the other is given.
template <class A>
void bind_alternatives(A& a, Joint& joint) {
  if constexpr (A::reads) {
    a.exactly_one({"group", "between"});
    if (a.has("between")) {
      a.value("between", joint.groups);
    } else {
      a.value("group", joint.groups[0]);
      joint.groups[1] = joint.groups[0];
      joint.inside_any = joint.groups[0] == every_group;
    }
    a.at_most_one({"friction", "friction_angle"});
    if (a.has("friction_angle")) {
      double angle = 0;
      a.value("friction_angle", angle);
      joint.friction = std::tan(angle);
    } else {
      a.value("friction", joint.friction);
    }
  } else {
    if (joint.inside())
      a.value("group", joint.groups[0]);
    else
      a.value("between", joint.groups);
    a.value("friction", joint.friction);
  }
}

template <class A>
void bind(A& a, Joint& joint) {
  a.origin(joint.origin);
  bind_alternatives(a, joint);
  bind_penalty(a, joint);
  a.choice("law", joint.law);
  a.choice("rise", joint.rise);
  a.choice("points", joint.points);
  a.value("size", joint.size);
  a.value("tensile_strength", joint.tensile_strength);
  if constexpr (A::reads) joint.shear_strength = joint.tensile_strength;
  a.value("shear_strength", joint.shear_strength);
  a.value("energy_mode_1", joint.energy_mode_1);
  if constexpr (A::reads) joint.energy_mode_2 = joint.energy_mode_1;
  a.value("energy_mode_2", joint.energy_mode_2);
  a.choice("energy_counts", joint.energy_of_whole_curve);
  a.value("points_to_fail", joint.points_to_fail);
  a.value("weibull_modulus", joint.weibull_modulus);
  a.value("weibull_area", joint.weibull_area);
  a.value("weibull_seed", joint.weibull_seed);
  a.section("softening", [&](auto& s) {
    s.choice("kind", joint.softening);
    s.value("a", joint.a);
    s.value("b", joint.b);
    s.value("c", joint.c);
    s.value("exponent", joint.exponent);
  });
}

template <class A>
void bind(A& a, Contact& contact) {
  a.origin(contact.origin);
  a.value("between", contact.groups);
  a.choice("interaction", contact.interaction);
  if (contact.interaction == Interaction::none) {
    if constexpr (A::reads) a.only({"between", "interaction"}, "interaction = \"none\"");
    return;
  }
  bind_penalty(a, contact);
  a.value("plateau", contact.plateau);
  a.value("unloading_exponent", contact.unloading_exponent);
  a.value("friction", contact.friction);
  a.value("friction_delay", contact.friction_delay);
  a.value("tangential_ratio", contact.tangential_ratio);
  a.value("damping_ratio", contact.damping_ratio);
  a.choice("points_on", contact.points_on);
  a.choice("initial_overlap", contact.initial_overlap);
}

template <class A>
void bind(A& a, ContactPoints& points) {
  a.origin(points.origin);
  a.value("per_face", points.per_face);
  a.choice("field", points.field);
  if constexpr (A::reads) points.everywhere = !a.has("surfaces");
  if (!points.everywhere) a.value("surfaces", points.surfaces);
}

template <class A>
void bind(A& a, Sphere& sphere) {
  a.origin(sphere.origin);
  a.value("centre", sphere.centre);
  a.value("radius", sphere.radius);
  a.value("penalty", sphere.penalty);
}

template <class A>
void bind(A& a, InitialVelocity& initial) {
  a.origin(initial.origin);
  a.value("group", initial.group);
  a.value("velocity", initial.velocity);
  a.value("random", initial.random);
  a.value("seed", initial.seed);
  a.value("angular", initial.angular);
  a.value("strain_rate", initial.strain_rate);
}

template <class A>
void bind(A& a, Constraint& constraint) {
  a.origin(constraint.origin);
  a.value("group", constraint.group);
  if constexpr (A::reads) {
    a.exactly_one({"fixed", "velocity", "displacement"});
    if (a.has("velocity"))
      constraint.kind = ConstraintKind::velocity;
    else if (a.has("displacement"))
      constraint.kind = ConstraintKind::displacement;
  }
  switch (constraint.kind) {
    case ConstraintKind::fixed:
      a.value("fixed", constraint.axes);
      break;
    case ConstraintKind::velocity:
      a.axis_functions("velocity", constraint.axes, constraint.value);
      break;
    case ConstraintKind::displacement:
      a.axis_functions("displacement", constraint.axes, constraint.value);
      break;
  }
}

template <class A>
void bind(A& a, Pressure& pressure) {
  a.origin(pressure.origin);
  a.value("surface", pressure.surface);
  a.value("value", pressure.value);
}

template <class A>
void bind(A& a, Traction& traction) {
  a.origin(traction.origin);
  a.value("surface", traction.surface);
  a.value("value", traction.value);
}

template <class A>
void bind(A& a, Force& force) {
  a.origin(force.origin);
  a.value("group", force.group);
  a.value("value", force.value);
}

template <class A>
void bind(A& a, Stage& stage) {
  a.origin(stage.origin);
  a.value("name", stage.name);
  a.value("end", stage.end);
  a.value("stop_when", stage.stop_when);
  a.value("gravity", stage.gravity);
  a.value("mass_damping", stage.mass_damping);
  a.value("local_damping", stage.local_damping);
  a.value("broken", stage.broken_surfaces);
  a.value("absorbing", stage.absorbing);
  a.list("constraint", stage.constraints);
  a.list("pressure", stage.pressures);
  a.list("traction", stage.tractions);
  a.list("force", stage.forces);
}

template <class A>
void bind(A& a, TimeControl& time) {
  a.origin(time.origin);
  a.value("step", time.step);
  a.value("safety", time.safety);
  a.value("max_steps", time.max_steps);
  a.value("residual_limit", time.residual_limit);
  a.value("energy_gain_limit", time.energy_gain_limit);
  a.value("stop_when", time.stop_when);
}

template <class A>
void bind(A& a, Detection& detection) {
  a.choice("algorithm", detection.algorithm);
  a.value("buffer", detection.buffer);
  a.value("cell", detection.cell);
  a.value("verify", detection.verify);
}

template <class A>
void bind(A& a, Domains& domains) {
  a.origin(domains.origin);
  a.choice("kind", domains.kind);
  a.value("n", domains.n);
  a.choice("exchange", domains.exchange);
  a.value("rebalance", domains.rebalance);
  a.value("margin", domains.margin);
  a.value("patience", domains.patience);
}

template <class A>
void bind(A& a, Checkpointing& checkpoint) {
  a.value("steps", checkpoint.steps);
  a.value("interval", checkpoint.interval);
  a.value("wall_interval", checkpoint.wall_interval);
  a.value("keep", checkpoint.keep);
}

template <class A>
void bind(A& a, Output& output) {
  a.origin(output.origin);
  a.value("frame_interval", output.frame_interval);
  a.value("history_interval", output.history_interval);
  a.value("elements", output.elements);
  a.value("joints", output.joints);
  a.value("contacts", output.contacts);
  a.value("gauges", output.gauges);
}

template <class A>
void bind(A& a, Region& region) {
  a.origin(region.origin);
  a.value("lower", region.lower);
  a.value("upper", region.upper);
}

template <class A>
void bind(A& a, Probe& probe) {
  a.origin(probe.origin);
  a.value("name", probe.name);
  a.value("at", probe.at);
  a.value("along", probe.along);
  a.value("points", probe.points);
  a.value("across", probe.across);
  a.value("rows", probe.rows);
}

template <class A>
void bind(A& a, Pipeline& pipeline) {
  a.origin(pipeline.origin);
  a.value("name", pipeline.name);
  a.value("every_steps", pipeline.every_steps);
  a.value("every_time", pipeline.every_time);
  a.value("every_wall", pipeline.every_wall);
  a.value("every_broken", pipeline.every_broken);
  a.value("first_break", pipeline.first_break);
  a.value("strict", pipeline.strict);
  a.value("least_instants", pipeline.least);
  a.value("parameters", pipeline.parameters);
  a.value("fields", pipeline.fields);
  a.optional_section("region", pipeline.region);
  a.list("probe", pipeline.probes);
}

template <class A>
void bind(A& a, Live& live) {
  a.origin(live.origin);
  a.value("address", live.address);
  a.value("remote", live.remote);
  a.value("interval", live.interval);
  a.value("channels", live.channels);
  a.value("max_overhead", live.max_overhead);
  a.value("fields", live.fields);
  a.optional_section("region", live.region);
}

template <class A>
void bind(A& a, InSitu& insitu) {
  a.origin(insitu.origin);
  a.value("max_overhead", insitu.max_overhead);
  a.value("least_instants", insitu.least_instants);
  a.choice("on_error", insitu.on_error);
  a.choice("backend", insitu.backend);
  a.optional_section("live", insitu.live);
  a.list("pipeline", insitu.pipelines);
  std::vector<std::string> names;  // written as pipelines of their own
  a.value("run", names);
  if constexpr (A::reads) {
    for (const std::string& name : names) {
      insitu.pipelines.emplace_back().name = name;
      insitu.pipelines.back().least = insitu.least_instants;
    }
    for (Pipeline& pipeline : insitu.pipelines) a.resolve_script(pipeline.name);
  }
}

/// A case that starts from a state may leave the mesh to it.
template <class A>
bool has_mesh(const A& a, const Case& c) {
  if constexpr (A::reads) {
    return a.has("mesh") || !a.has("start");
  } else {
    return !c.mesh.file.empty() || c.mesh.raster;
  }
}

/// Materials come before joints, whose penalty may be a multiple of Young's modulus.
template <class A>
void bind(A& a, Case& c) {
  a.value("title", c.title);
  a.optional_section("start", c.start);
  if (has_mesh(a, c)) a.section("mesh", [&](auto& s) { bind(s, c.mesh); });
  a.optional_section("plane", c.plane);
  a.list("material", c.materials);
  a.list("joint", c.joints);
  a.list("contact", c.contacts);
  a.section("contact_points", [&](auto& s) { bind(s, c.contact_points); });
  a.optional_section("sphere", c.sphere);
  a.section("joints", [&](auto& s) {
    s.origin(c.broken_origin);
    s.value("broken", c.broken_surfaces);
  });
  a.list("initial_velocity", c.initial_velocities);
  a.list("stage", c.stages);
  a.section("time", [&](auto& s) { bind(s, c.time); });
  a.section("detection", [&](auto& s) { bind(s, c.detection); });
  a.section("domains", [&](auto& s) { bind(s, c.domains); });
  a.section("checkpoint", [&](auto& s) { bind(s, c.checkpoint); });
  a.section("output", [&](auto& s) { bind(s, c.output); });
  a.list("gauge", c.gauges);
  a.list("trigger", c.triggers);
  a.section("insitu", [&](auto& s) { bind(s, c.insitu); });
}

}  // namespace breccia::case_
