#include "case/groups.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include "case/nearest.hpp"
#include "case/problem_at.hpp"
#include "case/validate.hpp"

namespace breccia::case_ {
namespace {

class GroupChecker {
 public:
  GroupChecker(const Case& c, const GroupNames& groups)
      : case_(c),
        volumes_(groups.volumes.begin(), groups.volumes.end()),
        surfaces_(groups.surfaces.begin(), groups.surfaces.end()),
        nodes_(groups.nodes.begin(), groups.nodes.end()) {
    for (const auto* names : {&volumes_, &surfaces_, &nodes_}) all_.insert(all_.end(), names->begin(), names->end());
  }

  void volume(const Origin& origin, const char* name, const std::string& group) {
    check(origin, name, group, volumes_, "volume group");
  }
  void surface(const Origin& origin, const char* name, const std::string& group) {
    check(origin, name, group, surfaces_, "surface group");
  }
  /// A curve or point is meant only where no volume or surface has its name.
  void any(const Origin& origin, const char* name, const std::string& group) {
    check(origin, name, group, all_, "volume, surface, curve or point group");
    if (has(volumes_, group) && has(surfaces_, group))
      add(problem_at(case_, origin, name,
                     "a volume group and a surface group of the mesh have this name: which is meant is not clear",
                     "groups with different names", group));
  }
  void gauge(const Origin& origin, const std::string& name, std::int64_t num_bodies) {
    const std::int64_t body = numbered_body(name);
    const bool is_group = has(all_, name);
    if (is_group && 0 <= body && body < num_bodies) {
      add(problem_at(case_, origin, "gauges",
                     "a group of the mesh has the name by which a gauge calls a body: which is meant is not clear",
                     "another name for the group, or another gauge", name));
    } else if (body < 0 || is_group) {
      any(origin, "gauges", name);
    } else if (body >= num_bodies) {
      add(problem_at(case_, origin, "gauges", "the mesh has no such body",
                     num_bodies > 0 ? "\"body 0\" to \"body " + std::to_string(num_bodies - 1) + "\"" : "", name));
    }
  }
  void add(Problem problem) { problems_.push_back(std::move(problem)); }
  std::vector<Problem> take() { return std::move(problems_); }

 private:
  static bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  }
  void check(const Origin& origin, const std::string& name, const std::string& group,
             const std::vector<std::string>& present, const std::string& kind) {
    if (has(present, group)) return;
    const std::string list = present.empty() ? "the mesh has none" : joined(nearest_first(group, present));
    const std::string what = has(nodes_, group)
                                 ? "this is a curve or point of the mesh, where a " + kind + " is asked for"
                                 : "the mesh has no " + kind + " \"" + group + "\"";
    add(problem_at(case_, origin, name, what, list, group));
  }

  const Case& case_;
  std::vector<std::string> volumes_, surfaces_, nodes_, all_;
  std::vector<Problem> problems_;
};

void check_stage(const Stage& stage, GroupChecker& checker) {
  for (const std::string& group : stage.broken_surfaces) checker.surface(stage.origin, "broken", group);
  for (const std::string& group : stage.absorbing) checker.surface(stage.origin, "absorbing", group);
  for (const Constraint& k : stage.constraints) checker.any(k.origin, "group", k.group);
  for (const Pressure& p : stage.pressures) checker.surface(p.origin, "surface", p.surface);
  for (const Traction& t : stage.tractions) checker.surface(t.origin, "surface", t.surface);
  for (const Force& f : stage.forces) checker.any(f.origin, "group", f.group);
}

}  // namespace

std::int64_t numbered_body(const std::string& name) {
  const std::string mark = "body ";
  if (!name.starts_with(mark) || name.size() == mark.size()) return -1;
  std::int64_t number = -1;
  const auto [end, error] = std::from_chars(name.data() + mark.size(), name.data() + name.size(), number);
  return error == std::errc() && end == name.data() + name.size() ? number : -1;
}

std::vector<Problem> check_groups(const Case& c, const GroupNames& groups, std::int64_t num_bodies) {
  GroupChecker checker(c, groups);
  std::set<std::string> with_material;
  for (const Material& m : c.materials) {
    checker.volume(m.origin, "group", m.group);
    with_material.insert(m.group);
  }
  for (const std::string& group : groups.volumes) {
    if (group == every_group)
      checker.add({c.file.string(), c.mesh.origin.line, "mesh",
                   "a volume group of the mesh has the name that stands for every group in [[joint]] and [[contact]]",
                   "another name for the group", group});
    if (!with_material.contains(group))
      checker.add({c.file.string(), c.mesh.origin.line, "material",
                   "the volume group \"" + group + "\" of the mesh has no material",
                   "a [[material]] for every volume group", group});
  }
  // Joints, contacts and initial velocities name groups with a material, which has been checked above.
  for (const std::string& group : c.contact_points.surfaces)
    checker.surface(c.contact_points.origin, "surfaces", group);
  for (const std::string& group : c.broken_surfaces) checker.surface(c.broken_origin, "broken", group);
  for (const Stage& stage : c.stages) check_stage(stage, checker);
  for (const std::string& group : c.output.gauges) checker.gauge(c.output.origin, group, num_bodies);
  return checker.take();
}

}  // namespace breccia::case_
