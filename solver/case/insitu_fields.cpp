#include "case/insitu_fields.hpp"

namespace breccia::case_ {
namespace {

const std::vector<std::string> kElement{"id",     "body",          "material",   "rank",        "fragment",
                                        "stress", "von_mises",     "principal",  "velocity",    "displacement",
                                        "cost",   "plastic_shear", "compaction", "plastic_work"};
const std::vector<std::string> kJoint{"id",     "damage",          "mode",  "opening", "slip",
                                      "broken", "time_of_failure", "state", "energy"};

std::vector<std::string> with(std::vector<std::string> names, std::initializer_list<const char*> more) {
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

}  // namespace

std::vector<std::string> fields_of_channel(std::string_view channel) {
  if (channel == "elements") return with(kElement, {"mass", "neighbour"});
  if (channel == "surface") return with(kElement, {"face", "crack"});
  if (channel == "joints" || channel == "fractures") return kJoint;
  if (channel == "contacts")
    return {"id",   "point",      "normal_force", "tangential_force", "force", "slip_velocity",
            "body", "other_body", "other_element"};
  if (channel == "domains") return {"rank", "elements", "joints", "couples", "load"};
  return {};
}

bool is_of_plasticity(std::string_view field) {
  return field == "plastic_shear" || field == "compaction" || field == "plastic_work";
}

}  // namespace breccia::case_
