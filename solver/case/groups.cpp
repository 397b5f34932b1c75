#include <algorithm>
#include <set>

#include "case/nearest.hpp"
#include "case/validate.hpp"

namespace breccia::case_ {
namespace {

class GroupChecker {
 public:
  GroupChecker(const Case& c, std::span<const std::string> volumes, std::span<const std::string> surfaces)
      : file_(c.file.string()),
        volumes_(volumes.begin(), volumes.end()),
        surfaces_(surfaces.begin(), surfaces.end()),
        both_(volumes_) {
    both_.insert(both_.end(), surfaces_.begin(), surfaces_.end());
  }

  void volume(const Origin& origin, const char* name, const std::string& group) {
    check(origin, name, group, volumes_, "volume group");
  }
  void surface(const Origin& origin, const char* name, const std::string& group) {
    check(origin, name, group, surfaces_, "surface group");
  }
  void either(const Origin& origin, const char* name, const std::string& group) {
    check(origin, name, group, both_, "volume or surface group");
  }
  void add(Problem problem) { problems_.push_back(std::move(problem)); }
  std::vector<Problem> take() { return std::move(problems_); }

 private:
  void check(const Origin& origin, const std::string& name, const std::string& group,
             const std::vector<std::string>& present, const std::string& kind) {
    if (std::find(present.begin(), present.end(), group) != present.end()) return;
    const std::string list = present.empty() ? "the mesh has none" : joined(nearest_first(group, present));
    problems_.push_back(
        {file_, origin.line, origin.key + "." + name, "the mesh has no " + kind + " \"" + group + "\"", list, group});
  }

  std::string file_;
  std::vector<std::string> volumes_, surfaces_, both_;
  std::vector<Problem> problems_;
};

void check_stage(const Stage& stage, GroupChecker& checker) {
  for (const std::string& group : stage.broken_surfaces) checker.surface(stage.origin, "broken", group);
  for (const Constraint& k : stage.constraints) checker.either(k.origin, "group", k.group);
  for (const Pressure& p : stage.pressures) checker.surface(p.origin, "surface", p.surface);
}

}  // namespace

std::vector<Problem> check_groups(const Case& c, std::span<const std::string> volume_groups,
                                  std::span<const std::string> surface_groups) {
  GroupChecker checker(c, volume_groups, surface_groups);
  std::set<std::string> with_material;
  for (const Material& m : c.materials) {
    checker.volume(m.origin, "group", m.group);
    with_material.insert(m.group);
  }
  for (const std::string& group : volume_groups)
    if (!with_material.contains(group))
      checker.add({c.file.string(), c.mesh.origin.line, "material",
                   "the volume group \"" + group + "\" of the mesh has no material",
                   "a [[material]] for every volume group", group});
  // Joints, contacts and initial velocities name groups with a material, which has been checked above.
  for (const std::string& group : c.contact_points.surfaces)
    checker.surface(c.contact_points.origin, "surfaces", group);
  for (const std::string& group : c.broken_surfaces) checker.surface(c.broken_origin, "broken", group);
  for (const Stage& stage : c.stages) check_stage(stage, checker);
  for (const std::string& group : c.output.gauges) checker.either(c.output.origin, "gauges", group);
  return checker.take();
}

}  // namespace breccia::case_
