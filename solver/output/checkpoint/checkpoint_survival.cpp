#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <string>
#include <thread>
#include <utility>

#include "output/checkpoint/checkpoint_writer.hpp"
#include "output/folder/run_lock.hpp"
#include "output/folder/status_sink.hpp"
#include "system/atomic_file.hpp"
#include "system/shared_file.hpp"
#include "system/write_all.hpp"

namespace breccia {
namespace {

// What the copy of a rank leaves in the file, in front of its checksums.
constexpr std::uint64_t kPartBegun = 1, kPartWritten = 2, kPartFailed = 3;

/// Between two attempts to read what other ranks have left.
constexpr auto kBetweenReads = std::chrono::milliseconds(20);
/// Copies begin together: one that has left nothing by then was never made.
constexpr auto kUntilBegun = std::chrono::seconds(10);
/// The time in which a part must be written after the first one is.
constexpr auto kUntilWritten = std::chrono::minutes(10);

OutputError with_text(const std::string& text) { return OutputError(Problem{"", 0, "", text, "", ""}); }

/// A report of a copy: its checksums, or why it has none.
std::string report_of(const std::vector<std::uint64_t>& sums, const std::optional<OutputError>& failure) {
  if (failure) return std::string("F") + failure->what();
  return "W" + std::string(reinterpret_cast<const char*>(sums.data()), sums.size() * sizeof(std::uint64_t));
}

void append_to(const std::filesystem::path& file, const std::string& line) {
  const Opened opened = open_regular(file, O_WRONLY | O_APPEND, Depth::file);
  if (opened) (void)write_all(opened.descriptor.get(), line);
}

}  // namespace

void CheckpointWriter::begin_process(const Survival& survival) {
  std::vector<OrphanNote> notes;
  const Opened status = open_regular(survival.status, O_WRONLY | O_APPEND, Depth::file);
  if (survival.lock >= 0) notes.push_back({survival.lock, true, owner_words("%PID%") + "\n"});
  if (status) {
    const Clock& clock = content_.model.clock;
    const std::string words = "the run was killed; process %PID% writes its checkpoint " + file_.filename().string();
    notes.push_back(
        {status.descriptor.get(), false, event_json({"checkpoint", words, "", true, clock.steps, clock.time}) + "\n"});
  }
  process_ = std::make_unique<SurvivingProcess>(
      [&](const SurvivingProcess::Parent& parent) { write_in_copy(parent, survival.status); }, std::move(notes));
  if (!process_->started()) process_.reset();
}

void CheckpointWriter::write_in_copy(const SurvivingProcess::Parent& parent, const std::filesystem::path& status) {
  leave_checksums(kPartBegun);
  write_part();
  try {
    leave_checksums(failure_ ? kPartFailed : kPartWritten);
  } catch (const OutputError& error) {
    if (!failure_) failure_ = error;
  }
  parent.report(report_of(sums_, failure_));
  if (!communicator_.is_root()) return;
  try {
    if (failure_) throw OutputError(*failure_);
    publish_in_copy();
    parent.report("");
  } catch (const OutputError& error) {
    failure_ = error;
    parent.report(error.what());
  }
  if (!parent.has_ended()) return;
  if (failure_) remove_unfinished();
  const std::string name = file_.filename().string();
  append_to(status, R"({"state":"interrupted","message":"killed as it ended by request; )" +
                        (failure_ ? "its checkpoint " + name + " could not be written"
                                  : "its checkpoint " + name + " is complete") +
                        "\"}\n");
}

/// Throws OutputError where a part of the file is missing.
void CheckpointWriter::publish_in_copy() {
  using Wall = std::chrono::steady_clock;
  const auto start = Wall::now();
  std::vector<std::vector<std::uint64_t>> of_ranks;
  for (std::size_t rank = 0; rank < static_cast<std::size_t>(communicator_.size());) {
    const auto left = checksums_left_by(rank);
    const std::uint64_t mark = left ? left->front() : 0;
    if (mark == kPartWritten) {
      of_ranks.emplace_back(left->begin() + 1, left->end());
      ++rank;
      continue;
    }
    const auto waited = Wall::now() - start;
    if (mark == kPartFailed || waited > kUntilWritten || (mark == 0 && waited > kUntilBegun))
      throw output_error(file_, "cannot write this file: the part of rank " + std::to_string(rank) + " is missing");
    std::this_thread::sleep_for(kBetweenReads);
  }
  set_checksums(of_ranks);
  publish();
}

/// Behind each other by rank: mark, checksums, checksum of both. There is room: the index has a longer text of each.
void CheckpointWriter::leave_checksums(std::uint64_t mark) const {
  std::vector<std::uint64_t> left{mark};
  left.insert(left.end(), sums_.begin(), sums_.end());
  left.push_back(checksum_of(std::as_bytes(std::span(left))));
  const auto bytes = std::as_bytes(std::span(left));
  SharedFile shared(temporary_of(file_), file_, 0);
  shared.write_at(index_place_.offset + static_cast<std::uint64_t>(communicator_.rank()) * bytes.size(), bytes);
  shared.finish();
}

/// Mark and checksums; nullopt: none yet. Opens the file anew, as file systems of several machines want it.
std::optional<std::vector<std::uint64_t>> CheckpointWriter::checksums_left_by(std::size_t rank) const {
  std::vector<std::uint64_t> left(sums_.size() + 2);
  const std::size_t size = left.size() * sizeof(std::uint64_t);
  const Opened opened = open_regular(temporary_of(file_), O_RDONLY, Depth::subfolder);
  if (!opened || ::pread(opened.descriptor.get(), left.data(), size,
                         static_cast<off_t>(index_place_.offset + rank * size)) != static_cast<ssize_t>(size))
    return std::nullopt;
  const std::uint64_t sum = left.back();
  left.pop_back();
  if (checksum_of(std::as_bytes(std::span(left))) != sum) return std::nullopt;
  return left;
}

/// In the run, as long as it lives. Collective. @return  false: there is no copy, or one has died; what it was to write
/// is written here then, and the file has yet to appear
bool CheckpointWriter::finish_process() {
  const std::optional<std::string> report = process_ ? process_->receive() : std::nullopt;
  const bool here = !report && process_;
  if (report && report->starts_with('F')) failure_ = with_text(report->substr(1));
  if (report && report->starts_with('W')) std::memcpy(sums_.data(), report->data() + 1, report->size() - 1);
  if (here) write_part();
  if (communicator_.max(static_cast<std::int64_t>(!report)) != 0 ||
      communicator_.max(static_cast<std::int64_t>(failure_.has_value())) != 0) {
    if (process_) process_->kill();
    process_.reset();
    return false;
  }
  const std::unique_ptr<SurvivingProcess> process = std::move(process_);
  communicator_.agree([&] {
    if (!communicator_.is_root()) return;
    const std::optional<std::string> end = process->receive();
    if (!end) throw output_error(file_, "cannot write this file: the process that writes it was killed");
    if (!end->empty()) throw with_text(*end);
  });
  process->wait();
  published_ = true;
  return true;
}

}  // namespace breccia
