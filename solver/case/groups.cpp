#include "case/groups.hpp"

#include <algorithm>
#include <charconv>
#include <set>
#include <span>

#include "case/joint_entries.hpp"
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
        nodes_(groups.nodes.begin(), groups.nodes.end()),
        of_elements_(volumes_) {
    of_elements_.insert(of_elements_.end(), groups.sets.begin(), groups.sets.end());
    for (const auto* names : {&of_elements_, &surfaces_, &nodes_})
      all_.insert(all_.end(), names->begin(), names->end());
  }

  void volume(const Origin& origin, const char* name, const std::string& group) {
    check(origin, name, group, volumes_, "volume group");
  }
  /// A volume group, with a material or without.
  void elements(const Origin& origin, const char* name, const std::string& group) {
    check(origin, name, group, of_elements_, "volume group");
  }
  void surface(const Origin& origin, const char* name, const std::string& group) {
    check(origin, name, group, surfaces_, "surface group");
  }
  /// A curve or point is meant only where no volume or surface has its name.
  void any(const Origin& origin, const char* name, const std::string& group) {
    check(origin, name, group, all_, "volume, surface, curve or point group");
    if (has(of_elements_, group) && has(surfaces_, group))
      add(problem_at(case_, origin, name,
                     "this name is ambiguous: a volume group and a surface group of the mesh have it",
                     "groups with different names", group));
  }
  /// What consists of corners of elements.
  void of_corners(const Origin& origin, const char* name, const std::string& group) {
    std::vector<std::string> known(all_);
    std::erase_if(known, [&](const std::string& g) { return has(volumes_, g); });
    check(origin, name, group, known, "surface, curve or point group, or element set");
  }
  void gauge(const Origin& origin, const std::string& name, std::int64_t num_bodies) {
    const std::int64_t body = numbered_body(name);
    const bool is_group = has(all_, name);
    if (is_group && 0 <= body && body < num_bodies) {
      add(problem_at(case_, origin, "gauges", "this name is ambiguous: a group of the mesh and a body have it",
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
    const std::string list = present.empty() ? "the mesh has none" : nearest_words(group, present);
    const std::string what = has(nodes_, group)
                                 ? "this is a curve or point of the mesh, where a " + kind + " is required"
                                 : "the mesh has no " + kind + " \"" + group + "\"";
    add(problem_at(case_, origin, name, what, list, group));
  }

  const Case& case_;
  std::vector<std::string> volumes_, surfaces_, nodes_;
  std::vector<std::string> of_elements_, all_;  ///< volumes and sets; and all others
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

const Material* material_of(const Case& input, const std::string& group) {
  const Material* found = nullptr;
  for (const Material& m : input.materials) {
    if (m.group == group) return &m;
    if (m.group == every_group) found = &m;
  }
  return found;
}

std::int64_t numbered_body(const std::string& name) {
  const std::string mark = "body ";
  if (!name.starts_with(mark) || name.size() == mark.size()) return -1;
  std::int64_t number = -1;
  const auto [end, error] = std::from_chars(name.data() + mark.size(), name.data() + name.size(), number);
  return error == std::errc() && end == name.data() + name.size() ? number : -1;
}

namespace {

/// What could not be checked before the groups of "*" were known.
class EveryGroup {
 public:
  EveryGroup(const Case& c, std::span<const std::string> volumes, GroupChecker& checker)
      : c_(c), volumes_(volumes), checker_(checker) {
    for (const Material& m : c.materials) {
      own_.insert(m.group);
      if (m.group == every_group) any_ = &m;
    }
  }

  void check() {
    if (any_ != nullptr) {
      if (std::all_of(volumes_.begin(), volumes_.end(), [&](const std::string& g) { return own_.contains(g); }))
        stands_for_none(any_->origin, "\"*\" where a volume group has no [[material]] of its own");
      names();
      joints();
      contacts();
    }
    for (const Joint& j : c_.joints) {
      const auto follows = [&](const std::string& g) {
        const Material* m = material_of(c_, g);
        return m != nullptr && m->joints != JointPlacement::none && joint_entry(c_, g, g).ruling == &j;
      };
      const bool is_default = !j.origin.key.starts_with("joint");
      if (j.inside_any && !is_default && std::none_of(volumes_.begin(), volumes_.end(), follows))
        stands_for_none(j.origin, "\"*\" where a group with joints has no [[joint]] of its own");
    }
  }

 private:
  void stands_for_none(const Origin& origin, const std::string& allowed) {
    checker_.add(problem_at(c_, origin, "group", "stands for no group of the mesh", allowed, every_group));
  }

  /// Groups without a material of their own may have any name.
  void names() {
    const auto check_name = [&](const Origin& origin, const char* key, const std::string& group) {
      if (group != every_group && !own_.contains(group)) checker_.volume(origin, key, group);
    };
    for (const Joint& j : c_.joints) {
      check_name(j.origin, j.inside() ? "group" : "between", j.groups[0]);
      if (!j.inside()) check_name(j.origin, "between", j.groups[1]);
    }
    for (const Contact& contact : c_.contacts)
      for (const std::string& group : contact.groups) check_name(contact.origin, "between", group);
  }

  void joints() {
    if (any_->joints != JointPlacement::breakable) return;
    for (const std::string& g : volumes_)
      if (!own_.contains(g) && joint_entry(c_, g, g).ruling == nullptr)
        checker_.add(problem_at(
            c_, any_->origin, "joints", "the group \"" + g + "\", one of \"*\", is breakable but has no joint law",
            "a [[joint]] with group = \"*\" or \"" + g + "\", or joints = \"unbreakable\" or \"none\"", g));
  }

  void contacts() {
    if (c_.contacts.empty()) return;
    const auto covered = [&](const std::string& a, const std::string& b) {
      return std::any_of(c_.contacts.begin(), c_.contacts.end(),
                         [&](const Contact& contact) { return fits(contact.groups, a, b); });
    };
    for (std::size_t i = 0; i < volumes_.size(); ++i) {
      for (std::size_t k = i; k < volumes_.size(); ++k) {
        const std::string &a = volumes_[i], &b = volumes_[k];
        const bool checked_before = own_.contains(a) && own_.contains(b);
        const bool can_touch = i != k || any_->joints == JointPlacement::breakable;
        if (checked_before || !can_touch || covered(a, b)) continue;
        checker_.add({c_.file.string(), c_.contacts.front().origin.line, "contact",
                      "no [[contact]] covers \"" + a + "\"" + (a == b ? "" : " and \"" + b + "\""),
                      "a [[contact]] of the pair, or of \"*\"", ""});
      }
    }
  }

  const Case& c_;
  std::span<const std::string> volumes_;
  GroupChecker& checker_;
  std::set<std::string> own_;  ///< groups with a material of their own, and "*"
  const Material* any_ = nullptr;
};

}  // namespace

std::vector<Problem> check_groups(const Case& c, const GroupNames& groups, std::int64_t num_bodies) {
  GroupChecker checker(c, groups);
  for (const Material& m : c.materials)
    if (m.group != every_group) checker.volume(m.origin, "group", m.group);
  for (const std::string& group : groups.volumes) {
    if (group == every_group)
      checker.add({c.file.string(), c.mesh.origin.line, "mesh",
                   "a volume group of the mesh has the name that stands for every group in [[material]], [[joint]] and "
                   "[[contact]]",
                   "another name for the group", group});
    if (material_of(c, group) == nullptr)
      checker.add({c.file.string(), c.mesh.origin.line, "material",
                   "the volume group \"" + group + "\" of the mesh has no material",
                   "a [[material]] for every volume group, or one of \"*\"", group});
  }
  // Joints and contacts name groups with a material, which has been checked above, but for "*".
  for (const InitialVelocity& v : c.initial_velocities) checker.elements(v.origin, "group", v.group);
  if (std::find(groups.volumes.begin(), groups.volumes.end(), every_group) == groups.volumes.end())
    EveryGroup(c, groups.volumes, checker).check();
  for (const std::string& group : c.contact_points.surfaces)
    checker.surface(c.contact_points.origin, "surfaces", group);
  for (const std::string& group : c.broken_surfaces) checker.surface(c.broken_origin, "broken", group);
  for (const Stage& stage : c.stages) check_stage(stage, checker);
  for (const std::string& group : c.output.gauges) checker.gauge(c.output.origin, group, num_bodies);
  for (const Gauge& gauge : c.gauges)
    if (gauge.kind == GaugeKind::cracks) checker.of_corners(gauge.origin, "group", gauge.group);
  return checker.take();
}

}  // namespace breccia::case_
