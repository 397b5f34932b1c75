#include "catalyst/replay.hpp"

#include <vtkAppendFilter.h>
#include <vtkAppendPolyData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>

#include <map>
#include <sstream>

#include "catalyst/extract_files.hpp"
#include "catalyst/recorded_history.hpp"
#include "catalyst/whole_file.hpp"

namespace breccia::insitu {
namespace {

namespace fs = std::filesystem;

/// What was recorded of one step.
struct Instant {
  double time = 0.0;
  std::array<fs::path, BRECCIA_NUM_CHANNELS> files;  ///< empty: not recorded at this step; of the history: its file
  [[nodiscard]] std::uint32_t channels() const {
    std::uint32_t mask = 0;
    for (int channel = 0; channel < BRECCIA_NUM_CHANNELS; ++channel) {
      if (!files[static_cast<std::size_t>(channel)].empty()) mask |= bit(channel);
    }
    return mask;
  }
};

struct Records {
  std::map<std::int64_t, Instant> instants;  ///< by step
  RecordedHistory history;
};

Records read_records(const fs::path& folder) {
  Records records;
  for (std::size_t channel = 0; channel < kChannelNames.size(); ++channel) {
    const std::string name = kChannelNames[channel];
    const fs::path place = folder / name;
    for (const RecordedInstant& recorded : read_pvd(place / (name + ".pvd"))) {
      Instant& instant = records.instants[recorded.step];
      instant.time = recorded.time;
      instant.files[channel] = place / recorded.file;
    }
  }
  const fs::path file = folder / "history" / "history.csv";
  records.history = read_history(file);
  for (const auto& [step, time] : records.history.times()) {
    Instant& instant = records.instants[step];
    instant.time = time;
    instant.files[BRECCIA_HISTORY] = file;
  }
  if (records.instants.empty())
    throw PipelineError(folder.string() + ": nothing is recorded there; expected " +
                        (folder / "surface/surface.pvd").string() +
                        " or another channel's (pipelines volume, surface, fractures, ... write them)");
  return records;
}

/// This rank's share of the pieces, put together; without cells when it has none.
vtkSmartPointer<vtkDataObject> read_share(const fs::path& file, const Ranks& ranks) {
  const auto pieces = read_summary(file);
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const auto size = static_cast<std::size_t>(ranks.size());
  const std::size_t begin = pieces.size() * rank / size;
  const std::size_t end = pieces.size() * (rank + 1) / size;
  if (begin == end) return empty_like(read_piece(pieces.front()));
  if (end - begin == 1) return read_piece(pieces[begin]);
  std::vector<vtkSmartPointer<vtkDataObject>> parts;
  for (std::size_t i = begin; i < end; ++i) parts.push_back(read_piece(pieces[i]));
  vtkSmartPointer<vtkAlgorithm> append;
  if (parts.front()->IsA("vtkPolyData") != 0) {
    append = vtkSmartPointer<vtkAppendPolyData>::New();
  } else {
    append = vtkSmartPointer<vtkAppendFilter>::New();
  }
  for (const auto& part : parts) append->AddInputDataObject(0, part);
  append->Update();
  return append->GetOutputDataObject(0);
}

Frame read_frame(const Records& records, std::int64_t step, std::uint32_t channels, const Ranks& ranks) {
  const Instant& instant = records.instants.at(step);
  Frame frame;
  frame.step = step;
  frame.time = instant.time;
  for (int channel = 0; channel < BRECCIA_NUM_CHANNELS; ++channel) {
    const auto index = static_cast<std::size_t>(channel);
    if ((channels & bit(channel)) == 0) continue;
    vtkSmartPointer<vtkDataObject> object;
    if (channel == BRECCIA_HISTORY) {
      object = records.history.table(step, ranks.is_root());
    } else {
      object = read_share(instant.files[index], ranks);
    }
    set_instant(object, step, instant.time);
    frame.channels[index] = object;
  }
  return frame;
}

std::string names_of(std::uint32_t channels) {
  std::string text;
  for (int channel = 0; channel < BRECCIA_NUM_CHANNELS; ++channel) {
    if ((channels & bit(channel)) != 0)
      text += (text.empty() ? "" : ", ") + std::string(kChannelNames[static_cast<std::size_t>(channel)]);
  }
  return text;
}

/// A result of `work` on this rank; what it throws on any rank is thrown on all.
template <class Work>
auto agreed(const Ranks& ranks, const Work& work) -> decltype(work()) {
  std::string error;
  decltype(work()) result{};
  try {
    result = work();
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  ranks.throw_agreed(error);
  return result;
}

constexpr std::size_t kMostNotices = 1 << 16;  // bytes

}  // namespace

std::string replay(Adaptor& adaptor, const fs::path& folder) {
  const Ranks& ranks = adaptor.ranks();
  const Records records = agreed(ranks, [&] { return read_records(folder); });
  std::uint32_t recorded = 0;
  for (const auto& [step, instant] : records.instants) recorded |= instant.channels();
  std::uint32_t failed = 0;
  std::string failures, notices;
  bool withheld = false;
  for (const auto& [step, instant] : records.instants) {
    std::uint32_t pipelines = 0;
    std::uint32_t channels = 0;
    for (int i = 0; i < adaptor.num_pipelines(); ++i) {
      if ((failed & bit(i)) != 0) continue;
      const std::uint32_t wanted = adaptor.channels(i, step, instant.time) & kAllChannels;
      if ((wanted & ~recorded) != 0)
        throw PipelineError(adaptor.name(i) + ": needs " + names_of(wanted & ~recorded) + ", of which " +
                            folder.string() + " has no record; it has " + names_of(recorded));
      if (wanted == 0 || (wanted & ~instant.channels()) != 0) continue;
      pipelines |= bit(i);
      channels |= wanted;
    }
    if (pipelines == 0) continue;
    const Frame frame = agreed(ranks, [&, at = step] { return read_frame(records, at, channels, ranks); });
    BrecciaRequests requests{};
    std::string text;
    const std::uint32_t now = adaptor.execute(pipelines, frame, requests, text);
    if (now != 0) failures += (failures.empty() ? "step " : "; step ") + std::to_string(step) + ": " + one_line(text);
    failed |= now;
    if (const std::string text = adaptor.notices(); notices.size() + text.size() < kMostNotices) {
      notices += text;
    } else {
      withheld = true;
    }
  }
  if (failed != 0) throw PipelineError(failures);
  return withheld ? notices + "further output of the scripts is in their logs, script.log\n" : notices;
}

}  // namespace breccia::insitu
