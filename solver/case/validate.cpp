#include "case/validate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/geometry_file.hpp"
#include "base/number_text.hpp"
#include "case/countable.hpp"
#include "case/groups.hpp"
#include "case/joint_entries.hpp"
#include "case/nearest.hpp"
#include "case/problem_at.hpp"
#include "case/schema.hpp"
#include "case/validate_experiment.hpp"
#include "case/validate_insitu.hpp"
#include "case/validate_motion.hpp"

namespace breccia::case_ {
namespace {

constexpr const char* unread = "";  // a group whose name was wrong, already reported

constexpr std::int64_t most_domains = 1000000;

using Pair = std::array<std::string, 2>;

using LawsSeen = std::map<std::pair<bool, Pair>, int>;  ///< whether inside a group, and of which: the line

constexpr double kRoundOff = 1e-9;

std::string in_seconds(double value) { return number_text(value, 4) + " s"; }

Pair sorted(Pair p) {
  if (p[1] < p[0]) std::swap(p[0], p[1]);
  return p;
}

std::string words(const Pair& p) { return p[0] == p[1] ? "\"" + p[0] + "\"" : "\"" + p[0] + "\" and \"" + p[1] + "\""; }

class Validator {
 public:
  Validator(const Case& c, bool needs_mesh_file) : c_(c), needs_mesh_file_(needs_mesh_file) {}

  std::vector<Problem> run() {
    mesh();
    materials();
    joints();
    contacts();
    for (const InitialVelocity& v : c_.initial_velocities) initial_velocity(v);
    stages();
    gauges();
    domains();
    return std::move(problems_);
  }

 private:
  void problem(const Origin& origin, const std::string& name, const std::string& what, const std::string& allowed = {},
               const std::string& given = {}) {
    problems_.push_back(problem_at(c_, origin, name, what, allowed, given));
  }

  [[nodiscard]] const Material* material(const std::string& group) const { return material_of(c_, group); }
  [[nodiscard]] int line_of(const Origin& origin, const char* name) const {
    return place_of(c_.file, origin, name).line;
  }
  /// Whether the group of a material could not be read, so that others may be missed in vain.
  [[nodiscard]] bool material_unread() const {
    return std::any_of(c_.materials.begin(), c_.materials.end(), [](const Material& m) { return m.group == unread; });
  }

  void needs_material(const Origin& origin, const std::string& name, const std::string& group) {
    if (group.empty() || material(group) != nullptr || material_unread()) return;
    std::vector<std::string> groups;
    for (const Material& m : c_.materials) groups.push_back(m.group);
    problem(origin, name, "no [[material]] has the group \"" + group + "\"", nearest_words(group, groups), group);
  }

  void mesh() {
    const MeshSource& mesh = c_.mesh;
    const bool of_state = c_.start && mesh.file.empty() && !mesh.raster;
    if (!of_state && mesh.file.empty() == !mesh.raster)
      problem(mesh.origin, "", "needs a source", "exactly one of file, raster");
    if (!mesh.file.empty()) {
      std::error_code error;
      const GeometryFile kind = geometry_file(mesh.file);
      if (std::filesystem::is_directory(mesh.file, error))
        problem(mesh.origin, "file", "is a folder", kGeometryFiles, mesh.file.string());
      else if (std::filesystem::exists(mesh.file, error) && !std::filesystem::is_regular_file(mesh.file, error))
        problem(mesh.origin, "file", "is no ordinary file", kGeometryFiles, mesh.file.string());
      else if (needs_mesh_file_ && !std::filesystem::is_regular_file(mesh.file, error))
        problem(mesh.origin, "file", "the file does not exist", kGeometryFiles, mesh.file.string());
      else if (kind == GeometryFile::unknown)
        problem(mesh.origin, "file",
                "is no mesh or solid that is read" +
                    (remedy_for(mesh.file).empty() ? std::string() : ": " + remedy_for(mesh.file)),
                kGeometryFiles, mesh.file.string());
      if (kind != GeometryFile::script && kind != GeometryFile::unknown && !mesh.parameters.empty())
        problem(mesh.origin, "parameters",
                is_solid(kind) ? "a solid takes no parameters" : "a finished mesh takes no parameters",
                "parameters of a .geo file");
      if (!is_solid(kind) && kind != GeometryFile::unknown && mesh.size != 0)
        problem(mesh.origin, "size", "only a solid is meshed with elements of a chosen size",
                "size with STEP, BREP and STL; a .geo sets its own");
    }
    if (mesh.raster) raster(*mesh.raster);
  }

  void domains() {
    const Domains& domains = c_.domains;
    const auto [x, y, z] = domains.n;
    const std::string given = "[" + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z) + "]";
    if (domains.kind != DomainKind::grid && domains.n != std::array{0, 0, 0})
      problem(domains.origin, "n", "belongs to a grid", "domains.kind = \"grid\", or no n", given);
    else if (std::int64_t{1} * x * y * z > most_domains)
      problem(domains.origin, "n", "is a grid of too many domains", "at most 1000000 in all", given);
  }

  void raster(const Raster& raster) {
    if (c_.mesh.size != 0 && c_.mesh.file.empty())
      problem(c_.mesh.origin, "size", "the raster has its size in cell_size", "size with STEP, BREP and STL");
    if (!c_.mesh.parameters.empty() && c_.mesh.file.empty())
      problem(c_.mesh.origin, "parameters", "the raster takes no parameters", "parameters of a .geo file");
    if (raster.single_tetrahedra && (raster.cells != std::array{1, 1, 1} || raster.slit))
      problem(c_.mesh.origin, "raster.kind", "single tetrahedra have no cells and no slit",
              "cells = [1, 1, 1], no slit", "tetrahedra");
    if (!raster.slit) return;
    const Vec3 extent = raster.slit->upper - raster.slit->lower;
    if (extent.minCoeff() != 0 || (extent.array() == 0).count() != 1)
      problem(c_.mesh.origin, "raster.slit", "is not plane",
              "upper above lower along two axes and equal to it along one");
  }

  void materials() {
    std::map<std::string, int> seen;
    for (const Material& m : c_.materials) {
      if (m.group.empty()) continue;
      const auto [first, is_new] = seen.emplace(m.group, line_of(m.origin, "group"));
      if (!is_new)
        problem(m.origin, "group", "the group has a material already, in line " + std::to_string(first->second),
                "one [[material]] a group", m.group);
    }
    for (const Material& m : c_.materials)
      validate(m.law, m.plasticity,
               [&](const char* name, const char* what, const std::string& allowed, const std::string& given) {
                 problem(m.origin, name, what, allowed, given);
               });
  }

  void joints() {
    LawsSeen seen;
    for (const Joint& j : c_.joints) joint(j, seen);
    const auto is_unread = [](const Joint& j) { return j.groups[0] == unread; };
    if (std::any_of(c_.joints.begin(), c_.joints.end(), is_unread)) return;  // it may be the law that is missed
    const auto has_law = [&](const std::string& group) {
      return seen.contains({true, {group, group}}) || seen.contains({true, {every_group, every_group}});
    };
    for (const Material& m : c_.materials)  // the groups of "*" are known with the mesh
      if (m.joints == JointPlacement::breakable && !m.group.empty() && m.group != every_group && !has_law(m.group))
        problem(m.origin, "joints", "the group is breakable but has no joint law",
                "a [[joint]] with group = \"" + m.group + "\", or joints = \"unbreakable\" or \"none\"", m.group);
  }

  /// Keys of one kind have no effect in another, so they are refused.
  void softening_of_another_kind(const Joint& j) {
    const Joint usual;
    const auto refuse = [&](const char* name, const char* kind) {
      problem(j.origin, std::string("softening.") + name, "belongs to a softening of another kind",
              std::string("kind = \"") + kind + "\"");
    };
    if (j.softening != Softening::z_curve) {
      if (j.a != usual.a) refuse("a", "z_curve");
      if (j.b != usual.b) refuse("b", "z_curve");
      if (j.c != usual.c) refuse("c", "z_curve");
    }
    if (j.softening != Softening::exponential && j.exponent != usual.exponent) refuse("exponent", "exponential");
  }

  void scatter(const Joint& j) {
    if (j.weibull_modulus > 0) return;
    const Joint usual;
    const std::string allowed = "a weibull_modulus as well";
    if (j.weibull_area > 0) problem(j.origin, "weibull_area", "has no effect without a weibull_modulus", allowed);
    if (j.weibull_seed != usual.weibull_seed)
      problem(j.origin, "weibull_seed", "has no effect without a weibull_modulus", allowed);
  }

  [[nodiscard]] bool is_breakable(const std::string& group) const {
    const Material* m = material(group);
    return m != nullptr && m->joints == JointPlacement::breakable;
  }

  /// Two breakable groups, or one alone, of which an entry is the law.
  [[nodiscard]] std::optional<Pair> breakable_pair(const Joint& j) const {
    if (j.groups == Pair{every_group, every_group}) {
      for (const Material& m : c_.materials)
        if (m.joints == JointPlacement::breakable && (m.group == every_group || (j.inside_any && rules(j, m.group))))
          return Pair{m.group, m.group};
    }
    if (j.groups[0] != every_group && j.groups[1] != every_group)
      return is_breakable(j.groups[0]) && is_breakable(j.groups[1]) ? std::optional(j.groups) : std::nullopt;
    for (const Material& a : c_.materials)
      for (const Material& b : c_.materials)
        if (a.joints == JointPlacement::breakable && b.joints == JointPlacement::breakable && a.group != b.group &&
            joint_entry(c_, a.group, b.group).ruling == &j)
          return Pair{a.group, b.group};
    return std::nullopt;
  }

  [[nodiscard]] bool rules(const Joint& j, const std::string& group) const {
    return joint_entry(c_, group, group).ruling == &j;
  }

  void joint(const Joint& j, LawsSeen& seen) {
    const bool inside = j.inside();
    for (const std::string& group : j.groups)
      if (group != every_group) needs_material(j.origin, inside ? "group" : "between", group);
    if (j.inside_any && material(every_group) == nullptr) {
      if (!material_unread())
        problem(j.origin, "group", "stands for no group", "\"*\" where a group with joints has no [[joint]] of its own",
                every_group);
      return;
    }
    const char* key = inside ? "group" : "between";
    if (!j.groups[0].empty()) {
      const auto [first, is_new] = seen.emplace(std::pair{inside, sorted(j.groups)}, line_of(j.origin, key));
      if (!is_new)
        return problem(j.origin, key, "the joints have a law already, in line " + std::to_string(first->second),
                       "one [[joint]] a group or pair", words(j.groups));
    }
    const bool of_parent = c_.start && c_.mesh.file.empty() && !c_.mesh.raster;  // it has the mesh
    if (!inside && !j.groups[0].empty() && !c_.mesh.glue && !of_parent)
      problem(j.origin, "between", "interfaces are not glued in this case", "mesh.glue = true", words(j.groups));
    if (j.softening == Softening::z_curve && j.a + j.b <= 1)
      problem(j.origin, "softening", "a + b of the z-curve is not above 1", "a + b > 1", std::to_string(j.a + j.b));

    softening_of_another_kind(j);
    scatter(j);
    if (inside && !j.inside_any && material(j.groups[0]) != nullptr &&
        material(j.groups[0])->joints == JointPlacement::none)
      problem(j.origin, "group", "the group has no joints",
              "joints = \"breakable\" or \"unbreakable\" in its [[material]], or between for its interface",
              j.groups[0]);
    const bool strong = !inside && (j.tensile_strength > 0 || j.shear_strength > 0 || j.energy_mode_1 > 0);
    // An interface without strengths is glue, unless both of its sides break.
    const std::optional<Pair> pair = strong ? j.groups : breakable_pair(j);
    if (!pair) return;
    const std::string why = "is missing: joints of " + words(*pair) + " can fail";
    if (j.tensile_strength == 0) problem(j.origin, "tensile_strength", why, "a strength > 0");
    if (j.energy_mode_1 == 0) problem(j.origin, "energy_mode_1", why, "a fracture energy > 0");
  }

  void contacts() {
    std::map<Pair, int> laws;
    for (const Contact& contact : c_.contacts) {
      if (contact.groups[0].empty()) continue;
      for (const std::string& group : contact.groups)
        if (group != every_group) needs_material(contact.origin, "between", group);
      if (contact.points_on == PointsOn::first && contact.groups[0] == contact.groups[1])
        problem(contact.origin, "points_on", "\"first\" requires two different groups",
                "two different groups in `between`", words(contact.groups));
      const auto [first, is_new] = laws.emplace(sorted(contact.groups), line_of(contact.origin, "between"));
      if (!is_new)
        problem(contact.origin, "between",
                "the pair has a [[contact]] already, in line " + std::to_string(first->second),
                "one [[contact]] a pair", words(contact.groups));
    }
    if (laws.empty()) return;
    const auto covered = [&](const std::string& a, const std::string& b) {
      const std::string any = every_group;
      return laws.contains(sorted({a, b})) || laws.contains(sorted({a, any})) || laws.contains(sorted({b, any})) ||
             laws.contains({any, any});
    };
    for (std::size_t i = 0; i < c_.materials.size(); ++i)
      for (std::size_t k = i; k < c_.materials.size(); ++k) {
        const Material &a = c_.materials[i], &b = c_.materials[k];
        if (a.group == every_group || b.group == every_group) continue;  // known with the mesh
        const bool can_touch = i != k || a.joints == JointPlacement::breakable;
        if (can_touch && !a.group.empty() && !b.group.empty() && !covered(a.group, b.group))
          problems_.push_back({c_.file.string(), c_.contacts.front().origin.line, "contact",
                               "no contact law covers " + words({a.group, b.group}),
                               "a [[contact]] of the pair, or of \"*\"", ""});
      }
  }

  void initial_velocity(const InitialVelocity& v) {
    if (c_.mesh.raster) needs_material(v.origin, "group", v.group);  // else it may be a group that carries none
    if (v.random[1] < v.random[0])
      problem(v.origin, "random", "the greatest speed is below the smallest", "[smallest, greatest]");
  }

  void stages() {
    std::set<std::string> names;
    double start = 0;
    for (const Stage& stage : c_.stages) {
      if (!stage.name.empty() && !names.insert(stage.name).second)
        problem(stage.origin, "name", "another stage has this name", "different names", stage.name);
      if (stage.end != 0 && !(stage.end > start))
        problem(stage.origin, "end", "the stage does not end after the one before", "> " + in_seconds(start),
                in_seconds(stage.end));
      if (c_.time.step > 0 && (stage.end - start) / c_.time.step > kMostSteps)
        problem(stage.origin, "end", "the stage would take more steps of the given time.step than can be counted",
                kAtMostSteps + (": a time.step of at least " + in_seconds((stage.end - start) / kMostSteps)),
                "time.step = " + in_seconds(c_.time.step));
      if (c_.time.step > 0 && stage.end > start && stage.end - start < (1 - kRoundOff) * c_.time.step)
        problem(stage.origin, "end", "the stage is shorter than one time.step, " + in_seconds(c_.time.step),
                "a time.step of at most " + in_seconds(stage.end - start) + ", or \"auto\"", in_seconds(stage.end));
      if (!stage.absorbing.empty() && (stage.mass_damping > 0 || stage.local_damping > 0))
        problem(stage.origin, "absorbing",
                "stands beside " + std::string(stage.mass_damping > 0 ? "mass_damping" : "local_damping") +
                    ", which damps the waves that are to leave",
                "one of them; material.viscosity may damp as well", "");
      if (stage.end != 0) start = stage.end;
      // An axis constrained twice in one group is ambiguous; axes of different groups that share nodes are checked with
      // the mesh.
      std::set<std::pair<std::string, std::size_t>> held;
      for (const Constraint& constraint : stage.constraints)
        for (std::size_t axis = 0; axis < 3; ++axis)
          if (constraint.axes[axis] && !constraint.group.empty() && !held.insert({constraint.group, axis}).second)
            problem(constraint.origin, "group", "the group is constrained already along " + std::string(1, "xyz"[axis]),
                    "one constraint a group and axis", constraint.group);
    }
  }

  void gauges() {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < c_.output.gauges.size(); ++i)
      if (!seen.insert(c_.output.gauges[i]).second)
        problem(c_.output.origin, "gauges[" + std::to_string(i) + "]", "the gauge stands twice", "each group once",
                c_.output.gauges[i]);
  }

  const Case& c_;
  bool needs_mesh_file_;
  std::vector<Problem> problems_;
};

}  // namespace

std::vector<Problem> validate(const Case& c, bool needs_mesh_file) {
  std::vector<Problem> problems = Validator(c, needs_mesh_file).run();
  for (const std::vector<Problem>& more : {validate_insitu(c), validate_motion(c), validate_experiment(c)})
    problems.insert(problems.end(), more.begin(), more.end());
  return problems;
}

}  // namespace breccia::case_
