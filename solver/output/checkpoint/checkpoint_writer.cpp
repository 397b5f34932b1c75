#include "output/checkpoint/checkpoint_writer.hpp"

#include <fcntl.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <system_error>
#include <utility>

#include "output/folder/folder_tree.hpp"
#include "output/frames/hdf5_file.hpp"
#include "system/atomic_file.hpp"
#include "system/shared_file.hpp"

namespace breccia {
namespace {

/// The dataset of the index, whose place is reserved before its text is known.
Column index_column(std::size_t size) { return {"", "index", NumberType::uint8, 1, {size, 0, size}, false, {}, ""}; }

Column hdf5_column(const CheckpointColumn& column, const Rows& rows) {
  return {column.group, column.name, column.type, column.components, rows, false, {}, column.unit};
}

Hdf5Format checkpoint_format(const std::vector<CheckpointColumn>& columns) {
  std::set<std::string> groups;
  for (const CheckpointColumn& column : columns) groups.insert(column.group);
  groups.erase("");
  return {"checkpoint", "BrecciaCheckpoint", {groups.begin(), groups.end()}, kCheckpointHeader};
}

std::vector<std::uint64_t> numbers_of(const std::vector<std::byte>& bytes) {
  std::vector<std::uint64_t> numbers(bytes.size() / sizeof(std::uint64_t));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

}  // namespace

CheckpointWriter::CheckpointWriter(std::filesystem::path file, Checkpoint content, const Communicator& communicator,
                                   std::vector<std::filesystem::path> companions, std::optional<Survival> survival)
    : file_(std::move(file)),
      content_(std::move(content)),
      communicator_(communicator),
      companions_(std::move(companions)),
      columns_(checkpoint_columns(content_)),
      survives_(survival.has_value()) {
  communicator_.set_phase("checkpoint");
  try {
    lay_out();
    sums_.resize(columns_.size());
    if (survival) begin_process(*survival);
    if (!process_) begin_writing();
  } catch (...) {
    remove_unfinished();  // what a full disk has taken of every checkpoint that failed would fill it for good
    throw;
  }
}

CheckpointWriter::~CheckpointWriter() {
  if (thread_.joinable()) thread_.join();
  if (!published_ && !process_) remove_unfinished();
}

/// Where no thread is to be had (a limit of processes or of memory) the steps wait for the whole of it.
void CheckpointWriter::begin_writing() {
  try {
    thread_ = std::thread([this] { write_part(); });
  } catch (const std::system_error&) {
    write_part();
  }
}

void CheckpointWriter::remove_unfinished() const {
  if (communicator_.is_root()) (void)remove_file(temporary_of(file_), Depth::subfolder);
}

/// Which rows are whose, which columns are worth a place, and where it is.
void CheckpointWriter::lay_out() {
  const auto rank = static_cast<std::size_t>(communicator_.rank());
  std::vector<double> stored;
  std::vector<std::uint64_t> mine;
  for (const CheckpointColumn& column : columns_) {
    const bool here = column.of_list || communicator_.is_root();
    mine.push_back(here ? column.rows : 0);
    stored.push_back(here && !column.is_zero() ? 1 : 0);
  }
  communicator_.max(stored);
  const auto of_ranks = communicator_.all_gather(std::span<const std::uint64_t>(mine));
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    IndexedColumn& column = index_.columns.emplace_back(
        IndexedColumn{columns_[c].path(), columns_[c].type, columns_[c].components, 0, stored[c] == 0, {}, {}});
    Rows& rows = rows_.emplace_back(Rows{mine[c], 0, 0});
    for (std::size_t r = 0; r < of_ranks.size(); ++r) {
      column.rows.push_back(of_ranks[r][c]);
      if (r < rank) rows.before += of_ranks[r][c];
      rows.total += of_ranks[r][c];
    }
  }
  std::vector<std::byte> places;
  communicator_.agree([&] {
    if (!communicator_.is_root()) return;
    try {
      std::vector<Column> stored_columns;
      for (std::size_t c = 0; c < columns_.size(); ++c) {
        if (!index_.columns[c].zero) stored_columns.push_back(hdf5_column(columns_[c], rows_[c]));
      }
      const std::size_t bound = index_bound(index_.columns, 2 * stored_columns.size() + 2, of_ranks.size());
      stored_columns.push_back(index_column(bound));
      const Hdf5Skeleton skeleton = hdf5_skeleton(stored_columns, checkpoint_format(columns_));
      index_.size = skeleton.size;
      index_place_ = {skeleton.offsets.back(), bound, 0};
      const SharedFile shared(temporary_of(file_), file_, O_CREAT);
      for (Hdf5Skeleton::Part part : skeleton.structure) {
        if (part.offset == 0) {  // the header's place, which stays empty until all is written
          part.offset = kCheckpointHeader;
          part.bytes.erase(part.bytes.begin(), part.bytes.begin() + kCheckpointHeader);
        }
        shared.write_at(part.offset, part.bytes);
        index_.structure.push_back({part.offset, part.bytes.size(), checksum_of(part.bytes)});
      }
      const auto bytes = std::as_bytes(std::span(skeleton.offsets));
      places.assign(bytes.begin(), bytes.end());
    } catch (const Hdf5Failure& failure) {
      throw output_error(file_, "cannot write this file: HDF5 failed at " + failure.what, failure.error_number);
    }
  });
  communicator_.broadcast(places);
  const std::vector<std::uint64_t> offsets = numbers_of(places);
  index_place_.offset = offsets.back();
  std::size_t next = 0;
  for (IndexedColumn& column : index_.columns) {
    if (!column.zero) column.offset = offsets.at(next++);
  }
}

/// In the thread: no MPI, and what goes wrong waits for finish().
void CheckpointWriter::write_part() {
  try {
    SharedFile shared(temporary_of(file_), file_, 0);
    if (communicator_.is_root()) shared.reserve(index_.size);
    std::vector<std::byte> bytes;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (index_.columns[c].zero || rows_[c].mine == 0) continue;
      columns_[c].pack(bytes);
      sums_[c] = checksum_of(bytes);
      shared.write_at(index_.columns[c].offset + rows_[c].before * columns_[c].row_size(), bytes);
    }
    shared.finish();
    for (const std::filesystem::path& companion : companions_) sync_file(companion);
  } catch (const OutputError& error) {
    failure_ = error;
  } catch (const std::exception& error) {
    failure_ = output_error(file_, std::string("cannot write this file: ") + error.what());
  }
  written_ = true;
}

void CheckpointWriter::gather_checksums() {
  set_checksums(communicator_.all_gather(std::span<const std::uint64_t>(sums_)));
}

void CheckpointWriter::set_checksums(const std::vector<std::vector<std::uint64_t>>& of_ranks) {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    IndexedColumn& column = index_.columns[c];
    for (std::size_t r = 0; r < of_ranks.size(); ++r)
      column.checksums.push_back(column.rows[r] == 0 ? checksum_of({}) : of_ranks[r][c]);
  }
}

void CheckpointWriter::publish() {
  index_.step = content_.model.clock.steps;
  index_.time = content_.model.clock.time;
  std::string text = index_text(index_);
  DEMAND(text.size() <= index_place_.size, std::to_string(text.size()) + " bytes of index");
  text.resize(index_place_.size, ' ');
  const auto bytes = std::as_bytes(std::span(text));
  index_place_.checksum = checksum_of(bytes);
  SharedFile shared(temporary_of(file_), file_, 0);
  shared.write_at(index_place_.offset, bytes);
  shared.write_at(0, header_bytes(index_place_, index_.size));
  shared.finish();
  const FileContent content{file_, {}};
  write_files_atomically({&content, 1}, Depth::subfolder);
}

void CheckpointWriter::finish() {
  if (thread_.joinable()) thread_.join();
  communicator_.set_phase("end of a checkpoint");
  if (survives_ && finish_process()) return;
  communicator_.agree([&] {
    if (failure_) throw OutputError(*failure_);
  });
  gather_checksums();
  communicator_.agree([&] {
    if (communicator_.is_root()) publish();
  });
  published_ = true;
}

}  // namespace breccia
