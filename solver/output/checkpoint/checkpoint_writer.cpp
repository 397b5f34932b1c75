#include "output/checkpoint/checkpoint_writer.hpp"

#include <fcntl.h>

#include <algorithm>
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

}  // namespace

CheckpointWriter::CheckpointWriter(std::unique_ptr<CheckpointRanks> ranks, std::filesystem::path file,
                                   Checkpoint content, std::vector<std::filesystem::path> companions)
    : file_(std::move(file)),
      content_(std::move(content)),
      ranks_(std::move(ranks)),
      companions_(std::move(companions)),
      columns_(checkpoint_columns(content_)) {
  ranks_->set_phase("checkpoint");
  try {
    lay_out();
    sums_.resize(columns_.size());
    begin_writing();
  } catch (...) {
    remove_unfinished();  // what a full disk has taken of every checkpoint that failed would fill it for good
    throw;
  }
}

CheckpointWriter::~CheckpointWriter() {
  if (thread_.joinable()) thread_.join();
  if (!published_) remove_unfinished();
}

/// Where no thread is to be had (a limit of processes or of memory) the steps wait for the whole of it.
void CheckpointWriter::begin_writing() {
  if (!ranks_->may_use_thread()) return write_part();
  try {
    thread_ = std::thread([this] { write_part(); });
  } catch (const std::system_error&) {
    write_part();
  }
}

void CheckpointWriter::remove_unfinished() const {
  if (ranks_->is_root()) (void)remove_file(temporary_of(file_), Depth::subfolder);
}

/// Which rows are whose, which columns are worth a place, and where it is.
void CheckpointWriter::lay_out() {
  const auto rank = static_cast<std::size_t>(ranks_->rank());
  std::vector<std::uint64_t> mine;  // rows, then whether they are worth a place
  for (const CheckpointColumn& column : columns_) {
    const bool here = column.of_list || ranks_->is_root();
    mine.push_back(here ? column.rows : 0);
  }
  for (const CheckpointColumn& column : columns_)
    mine.push_back((column.of_list || ranks_->is_root()) && !column.is_zero() ? 1 : 0);
  const auto of_ranks = ranks_->all_gather(mine);
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const bool zero = std::all_of(of_ranks.begin(), of_ranks.end(),
                                  [&](const auto& of_rank) { return of_rank[columns_.size() + c] == 0; });
    IndexedColumn& column = index_.columns.emplace_back(
        IndexedColumn{columns_[c].path(), columns_[c].type, columns_[c].components, 0, zero, {}, {}});
    Rows& rows = rows_.emplace_back(Rows{mine[c], 0, 0});
    for (std::size_t r = 0; r < of_ranks.size(); ++r) {
      column.rows.push_back(of_ranks[r][c]);
      if (r < rank) rows.before += of_ranks[r][c];
      rows.total += of_ranks[r][c];
    }
  }
  std::vector<std::uint64_t> places;
  ranks_->agree([&] {
    if (!ranks_->is_root()) return;
    try {
      std::vector<Column> stored_columns;
      for (std::size_t c = 0; c < columns_.size(); ++c) {
        if (!index_.columns[c].zero) stored_columns.push_back(hdf5_column(columns_[c], rows_[c]));
      }
      const std::size_t bound = index_bound(index_.columns, 2 * stored_columns.size() + 2, of_ranks.size());
      stored_columns.push_back(index_column(bound));
      Hdf5Skeleton skeleton = hdf5_skeleton(stored_columns, checkpoint_format(columns_));
      index_.size = skeleton.size;
      index_place_ = {skeleton.offsets.back(), bound, 0};
      const SharedFile made(temporary_of(file_), file_, O_CREAT);
      for (Hdf5Skeleton::Part& part : skeleton.structure) {
        if (part.offset == 0) {  // the header's place, which stays empty until all is written
          part.offset = kCheckpointHeader;
          part.bytes.erase(part.bytes.begin(), part.bytes.begin() + kCheckpointHeader);
        }
        index_.structure.push_back({part.offset, part.bytes.size(), checksum_of(part.bytes)});
        structure_.push_back(std::move(part.bytes));
      }
      places = std::move(skeleton.offsets);
    } catch (const Hdf5Failure& failure) {
      throw output_error(file_, "cannot write this file: HDF5 failed at " + failure.what, failure.error_number);
    }
  });
  const std::vector<std::uint64_t> offsets = ranks_->all_gather(places).front();
  std::size_t next = 0;
  for (IndexedColumn& column : index_.columns) {
    if (!column.zero) column.offset = offsets.at(next++);
  }
}

/// In the thread: no MPI, and what goes wrong waits for finish().
void CheckpointWriter::write_part() {
  try {
    SharedFile shared(temporary_of(file_), file_, 0);
    if (ranks_->is_root()) shared.reserve(index_.size);
    for (std::size_t p = 0; p < structure_.size(); ++p) shared.write_at(index_.structure[p].offset, structure_[p]);
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
  const auto of_ranks = ranks_->all_gather(sums_);
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
  ranks_->set_phase("end of a checkpoint");
  ranks_->agree([&] {
    if (failure_) throw OutputError(*failure_);
  });
  gather_checksums();
  ranks_->agree([&] {
    if (ranks_->is_root()) publish();
  });
  published_ = true;
}

}  // namespace breccia
