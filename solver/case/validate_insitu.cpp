#include "case/validate_insitu.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include "base/number_text.hpp"
#include "case/insitu_fields.hpp"
#include "case/live_address.hpp"
#include "case/nearest.hpp"
#include "case/problem_at.hpp"
#include "case/schema.hpp"

namespace breccia::case_ {
namespace {

constexpr std::size_t kMostPipelines = 31;  // and the live view: a mask of 32
constexpr std::size_t kMostProbes = 100;
constexpr std::int64_t kMostPoints = 100000;  // of a probe: lines of a file at each of its instants
constexpr const char* kProbes = "probes";

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The channels that a pipeline of ours records; none of pictures, probes and scripts.
std::string channel_of(const std::string& pipeline) {
  if (pipeline == "volume") return "elements";
  return pipeline == "elements" || fields_of_channel(pipeline).empty() ? std::string() : pipeline;
}

class InSituValidator {
 public:
  explicit InSituValidator(const Case& c) : c_(c) {
    plastic_ = std::any_of(c.materials.begin(), c.materials.end(),
                           [](const Material& m) { return m.law == BulkLaw::drucker_prager; });
  }

  std::vector<Problem> run() {
    for (const Pipeline& pipeline : c_.insitu.pipelines) this->pipeline(pipeline);
    if (c_.insitu.pipelines.size() > kMostPipelines)
      problem(c_.insitu.origin, "", "has too many pipelines", "at most " + std::to_string(kMostPipelines),
              std::to_string(c_.insitu.pipelines.size()));
    if (c_.insitu.live) live(*c_.insitu.live);
    return std::move(problems_);
  }

 private:
  void problem(const Origin& origin, const std::string& name, const std::string& what, const std::string& allowed = {},
               const std::string& given = {}) {
    problems_.push_back(problem_at(c_, origin, name, what, allowed, given));
  }

  void pipeline(const Pipeline& pipeline) {
    const Origin& origin = pipeline.origin.key.empty() ? c_.insitu.origin : pipeline.origin;
    const std::string key = pipeline.origin.key.empty() ? "run" : "name";
    const std::vector<std::string> known = key_of("insitu.pipeline[].name").choice_list();
    if (is_script(pipeline.name)) {
      std::error_code error;
      if (!std::filesystem::is_regular_file(pipeline.name, error))
        problem(origin, key, "the script does not exist", "a Python script exported from ParaView", pipeline.name);
    } else if (!pipeline.name.empty() && !contains(known, pipeline.name)) {
      problem(origin, key, "no pipeline has this name",
              nearest_words(pipeline.name, known) + ", or a script whose name ends with .py", pipeline.name);
      return;
    }
    selection(pipeline, origin);
    probes(pipeline, origin, key);
  }

  /// Pictures take the fields that they need, and the history has columns of its own.
  void selection(const Pipeline& pipeline, const Origin& origin) {
    if (pipeline.region) region(*pipeline.region);
    if (pipeline.name == "history") {
      if (pipeline.region || !pipeline.fields.empty())
        problem(origin, pipeline.fields.empty() ? "region" : "fields",
                "the history has neither cells nor fixed columns", "neither region nor fields");
    } else if (draws_pictures(pipeline.name)) {
      if (!pipeline.fields.empty())
        problem(origin, "fields", "pictures select their fields themselves", "no fields", joined(pipeline.fields));
    } else if (pipeline.name == kProbes) {
      if (pipeline.region) problem(pipeline.region->origin, "", "probes have their own positions", "no region");
      fields(origin, pipeline.fields, {"elements"});
    } else if (const std::string channel = channel_of(pipeline.name); !channel.empty()) {
      fields(origin, pipeline.fields, {channel});
    } else {
      fields(origin, pipeline.fields, key_of("insitu.live.channels").choice_list());
    }
  }

  void fields(const Origin& origin, const std::vector<std::string>& asked, const std::vector<std::string>& channels) {
    std::vector<std::string> known;
    for (const std::string& channel : channels)
      for (const std::string& field : fields_of_channel(channel))
        if (!contains(known, field) && (plastic_ || !is_of_plasticity(field))) known.push_back(field);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const std::string name = "fields[" + std::to_string(i) + "]";
      if (!contains(known, asked[i]))
        problem(origin, name,
                !plastic_ && is_of_plasticity(asked[i]) ? "no material has a law that remembers this"
                                                        : "there is no such field",
                nearest_words(asked[i], known), asked[i]);
      else if (std::find(asked.begin(), asked.begin() + static_cast<std::ptrdiff_t>(i), asked[i]) !=
               asked.begin() + static_cast<std::ptrdiff_t>(i))
        problem(origin, name, "the field stands twice", "each field once", asked[i]);
    }
  }

  void region(const Region& region) {
    for (int axis = 0; axis < 3; ++axis)
      if (!(region.upper[axis] > region.lower[axis]))
        problem(region.origin, "upper", "is not beyond the lower corner along " + std::string(1, "xyz"[axis]),
                "> " + number_text(region.lower[axis], 4) + " m", number_text(region.upper[axis], 4) + " m");
  }

  void probes(const Pipeline& pipeline, const Origin& origin, const std::string& key) {
    if (pipeline.name != kProbes) {
      if (!pipeline.probes.empty())
        problem(pipeline.probes.front().origin, "", "only the pipeline probes has probes", "name = \"probes\"",
                pipeline.name);
      return;
    }
    if (pipeline.probes.empty()) problem(origin, key, "has no probe", "one or more [[insitu.pipeline.probe]]", kProbes);
    if (pipeline.probes.size() > kMostProbes)
      problem(origin, key, "has too many probes", "at most " + std::to_string(kMostProbes),
              std::to_string(pipeline.probes.size()));
    std::set<std::string> names;
    for (const Probe& probe : pipeline.probes) {
      if (!names.insert(probe.name).second)
        problem(probe.origin, "name", "another probe has this name", "different names", probe.name);
      this->probe(probe);
    }
  }

  void probe(const Probe& probe) {
    const auto is_plain = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    };
    constexpr std::size_t longest = 64;
    if (probe.name.size() > longest || !std::all_of(probe.name.begin(), probe.name.end(), is_plain))
      problem(probe.origin, "name", "is no name of a file", "letters, digits, _ and -, up to 64", probe.name);
    side(probe, probe.along, probe.points, "along", "points");
    side(probe, probe.across, probe.rows, "across", "rows");
    if (std::int64_t{probe.points} * probe.rows > kMostPoints)
      problem(probe.origin, "rows", "there are too many points in all",
              "points times rows up to " + std::to_string(kMostPoints),
              std::to_string(std::int64_t{probe.points} * probe.rows));
  }

  void side(const Probe& probe, const Vec3& edge, int count, const std::string& name, const std::string& number) {
    const bool has_length = edge.cwiseAbs().maxCoeff() > 0;
    if (has_length && count < 2)
      problem(probe.origin, number, "are needed with " + name, ">= 2", std::to_string(count));
    if (!has_length && count > 1)
      problem(probe.origin, name, "has no length, but there are " + std::to_string(count) + " " + number,
              "a vector other than 0, or " + number + " = 1");
  }

  void live(const Live& live) {
    const std::vector<std::string> known = key_of("insitu.live.channels").choice_list();
    if (live.channels.empty()) problem(live.origin, "channels", "names no channel", joined(known), "[]");
    bool all_known = !live.channels.empty();
    for (const std::string& channel : live.channels) {
      if (contains(known, channel)) continue;
      all_known = false;
      problem(live.origin, "channels", "there is no such channel", nearest_words(channel, known), channel);
    }
    if (live.region) region(*live.region);
    if (all_known) fields(live.origin, live.fields, live.channels);
    const auto address = host_and_port(live.address);
    if (!address)
      problem(live.origin, "address", "is no address", "host:port, the port between 1 and 65535", live.address);
    else if (!live.remote && !is_loopback(address->first))
      problem(live.origin, "address", "is on another machine",
              "localhost, 127.0.0.1 or ::1, or insitu.live.remote = true", live.address);
  }

  const Case& c_;
  bool plastic_ = false;
  std::vector<Problem> problems_;
};

}  // namespace

std::vector<Problem> validate_insitu(const Case& c) { return InSituValidator(c).run(); }

}  // namespace breccia::case_
