#include "catalyst/script_bridge.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "catalyst/display.hpp"
#include "catalyst/pipeline_error.hpp"
#include "catalyst/pipeline_loop.hpp"

namespace breccia::insitu {

using nlohmann::json;

/// Known to breccia_catalyst2.py by their order.
struct ScriptBridge::Functions {
  const char* (*scripts)();
  const char* (*turn)();
  int (*agree)(const char* text);
  void (*done)(const char* error);
  int (*request)(const char* name, double value);
  void (*spare)(void* display);
  void (*note)(const char* script, const char* lines);
};

ScriptBridge* ScriptBridge::active = nullptr;

ScriptBridge::ScriptBridge(const Ranks& ranks, TurnWatch& watch, const BrecciaConfig& config,
                           const std::vector<BridgedScript>& scripts)
    : ranks_(ranks), watch_(watch) {
  const json about{
      {"title", config.title == nullptr ? "" : config.title}, {"end", config.end}, {"strength", config.strength}};
  json all = json::array();
  for (const BridgedScript& script : scripts) {
    all.push_back({{"name", script.name},
                   {"script", script.file.string()},
                   {"folder", script.folder.string()},
                   {"parameters", json::object()},
                   {"about", about}});
    for (const auto& [name, value] : script.parameters) {
      all.back()["parameters"][name] = {value.is_number() ? json(value.number) : json(nullptr),
                                        value.text ? json(*value.text) : json(nullptr)};
    }
  }
  scripts_ = all.dump(-1, ' ', false, json::error_handler_t::replace);
  active = this;
}

ScriptBridge::~ScriptBridge() { active = nullptr; }

std::string ScriptBridge::address() {
  static const Functions functions{scripts, turn, agree, done, request, spare_process, note};
  return std::to_string(reinterpret_cast<std::uintptr_t>(&functions));
}

void ScriptBridge::set_turn(const std::filesystem::path& script) {
  done_ = false;
  error_.clear();
  requests_ = {};
  turn_ = script.string();
}

void ScriptBridge::take_result(BrecciaRequests& requests) {
  if (!abandoned_.empty()) throw Abandoned(abandoned_);
  if (!error_.empty()) throw PipelineError(error_);
  if (!done_) throw PipelineError("ParaView has not run the script; its messages are above");
  requests.stop |= requests_.stop;
  requests.pause |= requests_.pause;
  requests.extract |= requests_.extract;
  if (requests_.frame_interval > 0) requests.frame_interval = requests_.frame_interval;
}

const char* ScriptBridge::scripts() { return active == nullptr ? "[]" : active->scripts_.c_str(); }
const char* ScriptBridge::turn() { return active == nullptr ? "" : active->turn_.c_str(); }

/// No exception may pass through Python: 2 is "others do not come".
int ScriptBridge::agree(const char* text) {
  if (active == nullptr) return 0;
  try {
    if (!active->abandoned_.empty()) return 2;
    active->watch_.restart();
    const int answer = active->ranks_.agree(text).empty() ? 0 : 1;
    active->watch_.restart();  // that was waiting for others
    return answer;
  } catch (const Abandoned& wait) {
    active->abandoned_ = wait.what();
    return 2;
  }
}

void ScriptBridge::done(const char* error) {
  if (active == nullptr) return;
  active->done_ = true;
  if (active->error_.empty()) active->error_ = error;
}

void ScriptBridge::note(const char* script, const char* lines) {
  if (active != nullptr) active->notices_ += with_name(script, lines);
}

int ScriptBridge::request(const char* name, double value) {
  if (active == nullptr) return 0;
  BrecciaRequests& requests = active->requests_;
  const std::string_view what = name;
  const auto flag = static_cast<std::int32_t>(value != 0.0);
  if (what == "stop") {
    requests.stop = flag;
  } else if (what == "pause") {
    requests.pause = flag;
  } else if (what == "extract") {
    requests.extract = flag;
  } else if (what == "frame_interval") {
    requests.frame_interval = value;
  } else {
    return 0;
  }
  return 1;
}

}  // namespace breccia::insitu
