#include "catalyst/pipeline_choice.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "catalyst/channel_names.hpp"
#include "catalyst/folders.hpp"

namespace breccia::insitu {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProbes = "probes";
constexpr const char* kPointData = "point_data";
constexpr const char* kModules = "breccia_";  ///< what scripts import is called so, and no script itself

/// "volume" is the channel elements, other recordings are called like their channels; -1: no recording.
int recorded_channel(const std::string& name) {
  if (name == "volume") return BRECCIA_ELEMENTS;
  return name == kChannelNames[BRECCIA_ELEMENTS] ? -1 : channel_of(name);
}

std::vector<std::string> ready_scripts() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(data_folder() / "pipelines", error)) {
    const std::string name = entry.path().stem();
    if (entry.path().extension() == ".py" && !name.starts_with(kModules)) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

Probe probe_of(const BrecciaProbe& given) {
  Probe probe{
      given.name, std::to_array(given.at), std::to_array(given.along), std::to_array(given.across), given.points,
      given.rows};
  // It becomes a file's name.
  if (probe.name.empty() || probe.name.find_first_of("/.") != std::string::npos)
    throw PipelineError("the probe's name '" + probe.name + "' is no name of a file");
  if (probe.points < 1 || probe.rows < 1) throw PipelineError("the probe " + probe.name + " has no points");
  return probe;
}

/// Values that there are at points; those of bulk laws where a material has such.
constexpr const char* kPointFields[] = {"displacement", "velocity",      "stress",     "von_mises",
                                        "principal",    "plastic_shear", "compaction", "plastic_work"};

/// The parameter point_data, "von_mises, velocity", becomes part of the selection.
void take_point_data(PipelineChoice& choice) {
  const auto found = choice.parameters.find(kPointData);
  if (found == choice.parameters.end()) return;
  if (!found->second.text)
    throw PipelineError(std::string(kPointData) + " is a text, names of fields separated by commas");
  std::string text = *found->second.text;
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream names(text);
  for (std::string name; names >> name;) {
    if (std::find(std::begin(kPointFields), std::end(kPointFields), name) == std::end(kPointFields)) {
      std::string allowed;
      for (const char* known : kPointFields) allowed += (allowed.empty() ? "" : ", ") + std::string(known);
      throw PipelineError(std::string(kPointData) + " has no field '" + name + "'; allowed: " + allowed);
    }
    choice.selection.point_fields.push_back(name);
  }
  if (choice.selection.point_fields.empty()) throw PipelineError(std::string(kPointData) + " names no field");
  choice.parameters.erase(found);
}

std::string unknown(const std::string& name) {
  std::string text = name + ": no pipeline has this name; allowed: ";
  for (const std::string& known : pipeline_names()) text += known + ", ";
  return text + "or the absolute path of a script, /.../name.py";
}

}  // namespace

std::vector<std::string> pipeline_names() {
  std::vector<std::string> names{"volume"};
  for (int channel = BRECCIA_ELEMENTS + 1; channel < BRECCIA_NUM_CHANNELS; ++channel)
    names.emplace_back(kChannelNames[static_cast<std::size_t>(channel)]);
  names.emplace_back(kProbes);
  names.emplace_back("live");
  const auto scripts = ready_scripts();
  names.insert(names.end(), scripts.begin(), scripts.end());
  return names;
}

PipelineChoice choose(const BrecciaPipeline& pipeline) {
  PipelineChoice choice;
  choice.name = pipeline.name;
  choice.channels = pipeline.channels;
  for (std::int32_t i = 0; i < pipeline.num_parameters; ++i) {
    const BrecciaParameter& given = pipeline.parameters[i];
    Parameter& parameter = choice.parameters[given.name];
    parameter.number = given.number;
    if (given.text != nullptr) parameter.text = given.text;
  }
  if (pipeline.region != nullptr) std::copy_n(pipeline.region, 6, choice.selection.region.emplace().begin());
  choice.selection.fields.assign(pipeline.fields, pipeline.fields + pipeline.num_fields);
  take_point_data(choice);
  for (std::int32_t i = 0; i < pipeline.num_probes; ++i) choice.probes.push_back(probe_of(pipeline.probes[i]));
  if (choice.name == "live") {
    choice.kind = PipelineKind::live;
  } else if (choice.name == kProbes) {
    choice.kind = PipelineKind::probes;
    choice.channel = BRECCIA_ELEMENTS;
    choice.folder = kProbes;
  } else if (const int channel = recorded_channel(choice.name); channel >= 0) {
    choice.kind = channel == BRECCIA_HISTORY ? PipelineKind::history : PipelineKind::extract;
    choice.channel = channel;
    choice.folder = kChannelNames[static_cast<std::size_t>(channel)];
  } else {
    choice.kind = PipelineKind::script;
    choice.file = choice.name;
    if (!choice.file.is_absolute()) {
      const auto scripts = ready_scripts();
      if (std::find(scripts.begin(), scripts.end(), choice.name) == scripts.end())
        throw PipelineError(unknown(choice.name));
      choice.ready = true;
      choice.file = data_folder() / "pipelines" / (choice.name + ".py");
    }
    choice.folder = choice.file.stem();
  }
  if (!choice.selection.point_fields.empty() &&
      (choice.kind == PipelineKind::history || choice.kind == PipelineKind::probes ||
       (choice.kind == PipelineKind::extract && choice.channel != BRECCIA_ELEMENTS &&
        choice.channel != BRECCIA_SURFACE)))
    throw PipelineError(std::string(kPointData) + ": only the channels elements and surface have values at points");
  return choice;
}

}  // namespace breccia::insitu
