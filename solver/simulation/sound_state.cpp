#include "simulation/sound_state.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "output/checkpoint/checkpoint.hpp"

namespace breccia {
namespace {

std::string words_of_files(const SoundState& sound, const RunFolder& folder) {
  const std::vector<CheckpointEntry> all = checkpoints_in(folder.checkpoints());
  const auto last = std::find_if(all.begin(), all.end(), [&](const auto& entry) { return entry.step <= sound.step; });
  const std::string frame = sound.frame >= 0 ? "frame " + std::to_string(sound.frame) : "no frame";
  if (last == all.end())
    return "; sound before that: " + frame + ", no checkpoint (set checkpoint.steps or checkpoint.interval)";
  return "; sound before that: " + last->file.string() + ", " + frame + "; a case with [start] from = \"" +
         folder.root.string() + "\", step = " + std::to_string(last->step) +
         " continues from there with other settings";
}

}  // namespace

std::string words_of(const SoundState& sound, const RunFolder& folder, const Communicator& communicator) {
  std::vector<std::byte> bytes;
  if (communicator.is_root()) {
    const std::string text = words_of_files(sound, folder);
    const auto raw = std::as_bytes(std::span(text));
    bytes.assign(raw.begin(), raw.end());
  }
  communicator.broadcast(bytes);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace breccia
