#include "output/checkpoint/surviving_checkpoint.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <utility>

#include "output/checkpoint/checkpoint_writer.hpp"
#include "output/folder/run_lock.hpp"
#include "output/folder/status_sink.hpp"
#include "system/atomic_file.hpp"
#include "system/open_regular.hpp"
#include "system/write_all.hpp"

namespace breccia {
namespace {

/// A number of its own for each checkpoint, the same on all ranks. Collective.
std::uint64_t token_of(const Communicator& communicator) {
  const auto now = static_cast<std::uint64_t>(std::chrono::system_clock::now().time_since_epoch().count());
  const std::uint64_t mine = now ^ (static_cast<std::uint64_t>(::getpid()) << 40U);
  return communicator.all_gather(std::span<const std::uint64_t>(&mine, 1)).front().front();
}

/// What the copy of the root reports when the run is killed: the lock's owner, and what it does.
std::vector<OrphanNote> notes_of(const SurvivingCheckpoint::Place& place, int status, const Clock& clock) {
  std::vector<OrphanNote> notes;
  if (place.lock >= 0) notes.push_back({place.lock, true, owner_words("%PID%") + "\n"});
  if (status < 0) return notes;
  const std::string words = "the run was killed; process %PID% writes its checkpoint " + place.file.filename().string();
  notes.push_back({status, false, event_json({"checkpoint", words, "", true, clock.steps, clock.time}) + "\n"});
  return notes;
}

std::string last_words(const std::filesystem::path& file, bool written) {
  return R"({"state":"interrupted","message":"killed as it ended; its checkpoint )" + file.filename().string() +
         (written ? " is complete" : " could not be written") + "\"}\n";
}

}  // namespace

SurvivingCheckpoint::SurvivingCheckpoint(Place place, const Clock& clock, const std::function<Checkpoint()>& content,
                                         const Communicator& communicator)
    : communicator_(communicator) {
  const std::uint64_t token = token_of(communicator);
  const bool root = communicator.is_root();
  const Opened status = root ? open_regular(place.status, O_WRONLY | O_APPEND, Depth::file) : Opened();
  const auto work = [&](const SurvivingProcess::Parent& parent) {
    std::string report;
    try {
      auto ranks = std::make_unique<FileRanks>(communicator.rank(), communicator.size(), place.file, token);
      CheckpointWriter writer(std::move(ranks), place.file, content(), place.companions);
      writer.finish();
      report = "W" + std::to_string(writer.bytes());
    } catch (const OutputError& error) {
      report = std::string("F") + error.what();
    }
    parent.report(report);
    if (status && parent.has_ended())
      (void)write_all(status.descriptor.get(), last_words(place.file, report.front() == 'W'));
  };
  process_ = std::make_unique<SurvivingProcess>(
      work, root ? notes_of(place, status.descriptor.get(), clock) : std::vector<OrphanNote>());
}

std::optional<std::uint64_t> SurvivingCheckpoint::finish() {
  communicator_.set_phase("end of a checkpoint");
  const std::optional<std::string> report = process_->receive();
  const bool failed = communicator_.max(static_cast<std::int64_t>(!report)) != 0;
  if (failed) process_->kill();
  process_->wait();
  if (failed) return std::nullopt;
  communicator_.agree([&] {
    if (report->front() == 'F') throw OutputError(Problem{"", 0, "", report->substr(1), "", ""});
  });
  return std::stoull(report->substr(1));
}

}  // namespace breccia
