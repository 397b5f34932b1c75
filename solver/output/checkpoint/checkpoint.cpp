#include "output/checkpoint/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <regex>
#include <system_error>

#include "base/error.hpp"
#include "output/checkpoint/checkpoint_columns.hpp"
#include "output/checkpoint/checkpoint_index.hpp"
#include "output/checkpoint/checkpoint_writer.hpp"
#include "output/folder/folder_tree.hpp"
#include "system/atomic_file.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// One rank's part of a checkpoint: the columns of a piece, verified.
class PieceReader {
 public:
  PieceReader(const fs::path& file, const CheckpointIndex& index) : file_(file) {
    for (const IndexedColumn& column : index.columns) {
      Stored& stored = stored_[column.path];
      stored.column = &column;
      stored.before.assign(column.rows.size(), 0);
      std::exclusive_scan(column.rows.begin(), column.rows.end(), stored.before.begin(), std::uint64_t{0});
    }
  }

  /// The records that a rank wrote.
  Records records(std::size_t piece) const {
    Checkpoint part;
    std::vector<std::size_t> lengths;
    const std::vector<CheckpointColumn> of_lists = checkpoint_columns(part);
    for (const NamedLength& list : lengths_of_lists(part.mine)) {
      std::size_t length = 0;
      bool first = true;
      for (const CheckpointColumn& column : of_lists) {
        if (!column.of_list || column.group != list.name) continue;
        const std::vector<std::uint64_t>& rows = indexed(column).column->rows;
        const std::size_t here = piece < rows.size() ? rows[piece] : 0;
        if (!first && here != length)
          refuse_checkpoint(file_, "this checkpoint is damaged: " + list.name + " has columns of two lengths");
        length = here;
        first = false;
      }
      lengths.push_back(length);
    }
    lengthen_lists(part.mine, lengths);
    for (const CheckpointColumn& column : checkpoint_columns(part)) {
      if (column.of_list) read(column, piece);
    }
    return std::move(part.mine);
  }

  /// What all ranks have of the model and the run.
  void read_whole(Checkpoint& checkpoint) const {
    for (const CheckpointColumn& column : checkpoint_columns(checkpoint)) {
      if (!column.of_list) read(column, 0);
    }
  }

 private:
  struct Stored {
    const IndexedColumn* column = nullptr;
    std::vector<std::uint64_t> before;  ///< (pieces) rows of the pieces before
  };

  const Stored& indexed(const CheckpointColumn& column) const {
    const auto found = stored_.find(column.path());
    if (found == stored_.end())
      refuse_checkpoint(file_, "this checkpoint is of another version of breccia, without " + column.path());
    const IndexedColumn& stored = *found->second.column;
    if (stored.type != column.type || stored.components != column.components)
      refuse_checkpoint(file_,
                        "this checkpoint is of another version of breccia: " + column.path() + " has another form");
    return found->second;
  }

  void read(const CheckpointColumn& column, std::size_t piece) const {
    const Stored& found = indexed(column);
    const IndexedColumn& stored = *found.column;
    if (piece >= stored.rows.size()) return;
    const std::uint64_t row = column.row_size(), size = stored.rows[piece] * row;
    if (stored.zero) {  // written over what records begin with, which need not be 0
      if (!column.of_list) refuse_checkpoint(file_, "this checkpoint is damaged: " + column.path());
      if (size > 0) column.unpack(std::vector<std::byte>(size), 0);
      return;
    }
    const IndexedBytes place{stored.offset + found.before[piece] * row, size, stored.checksums[piece]};
    const std::vector<std::byte> bytes = read_verified(file_, place, column.path());
    if (!column.of_list && column.components > 1 && bytes.size() != row)
      refuse_checkpoint(file_, "this checkpoint is damaged: " + column.path());
    if (!bytes.empty()) column.unpack(bytes, 0);
  }

  fs::path file_;
  std::map<std::string, Stored> stored_;
};

std::size_t num_pieces(const CheckpointIndex& index) {
  std::size_t pieces = 0;
  for (const IndexedColumn& column : index.columns) pieces = std::max(pieces, column.rows.size());
  return pieces;
}

/// Whether a run can have come here: times are numbers, the next step has a length, and steps can be counted further.
bool are_possible(const Clock& clock, const RunPosition& position) {
  constexpr std::int64_t kMostSteps = 1'000'000'000'000'000'000;  // the name of a checkpoint has no more digits
  const auto not_negative = [](double time) { return std::isfinite(time) && time >= 0; };
  return not_negative(clock.time) && not_negative(clock.dt) && clock.dt > 0 && not_negative(clock.dt_before) &&
         not_negative(clock.dt_earlier) && 0 <= clock.steps && clock.steps < kMostSteps &&
         not_negative(position.start_time) && not_negative(position.saved) && not_negative(position.saved_before) &&
         0 <= position.start_step && position.start_step <= clock.steps;
}

/// Whether every list ascends by element and names only elements of the checkpoint.
bool belong_together(const Records& records) {
  const auto before = [](const ElementRecord& a, const ElementRecord& b) { return a.id < b.id; };
  if (!std::is_sorted(records.elements.begin(), records.elements.end(), before)) return false;
  bool good = true;
  for_each_list(records, [&](const char*, const auto& list) {
    if constexpr (!std::is_same_v<std::decay_t<decltype(list)>, std::vector<ElementRecord>>) {
      std::size_t place = 0;
      for (const auto& record : list) {
        while (place < records.elements.size() && records.elements[place].id < record.element) ++place;
        good = good && place < records.elements.size() && records.elements[place].id == record.element;
      }
    }
  });
  return good;
}

/// What killed runs left of checkpoints. One that cannot be removed is no harm.
void remove_left_over(const fs::path& folder) {
  std::error_code ignored;
  static const std::regex unfinished(R"(\.step_\d+\.h5(\.\d+\.\d+)?\.tmp)");
  std::vector<fs::path> left_over;
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end; entry.increment(ignored)) {
    if (std::regex_match(entry->path().filename().string(), unfinished)) left_over.push_back(entry->path());
  }
  for (const fs::path& file : left_over) (void)remove_file(file, Depth::subfolder);
}

}  // namespace

fs::path checkpoint_file(const fs::path& folder, std::int64_t step) {
  return folder / fmt::format("step_{:012}.h5", step);
}

std::vector<CheckpointEntry> checkpoints_in(const fs::path& folder) {
  static const std::regex pattern(R"(step_(\d{12,18})\.h5)");
  std::vector<CheckpointEntry> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::smatch match;
    const std::string name = entry->path().filename().string();
    if (std::regex_match(name, match, pattern)) found.push_back({std::stoll(match[1].str()), entry->path()});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.step > b.step; });
  return found;
}

void remove_old_checkpoints(const fs::path& folder, std::int64_t keep, std::int64_t sound_step) {
  const std::vector<CheckpointEntry> all = checkpoints_in(folder);
  const auto sound = std::find_if(all.begin(), all.end(), [&](const auto& entry) { return entry.step <= sound_step; });
  // One that cannot be removed is no harm.
  for (auto entry = all.begin() + std::min(keep, std::ssize(all)); entry != all.end(); ++entry) {
    if (entry != sound) (void)remove_file(entry->file, Depth::subfolder);
  }
  remove_left_over(folder);
}

void remove_checkpoints_after(const fs::path& folder, std::int64_t step) {
  for (const CheckpointEntry& entry : checkpoints_in(folder)) {
    const std::string why = entry.step > step ? remove_file(entry.file, Depth::subfolder) : std::string();
    if (!why.empty())
      throw output_error(entry.file, "cannot remove this checkpoint, which is ahead of the run: " + why);
  }
}

void remove_checkpoints(const fs::path& folder) {
  for (const CheckpointEntry& entry : checkpoints_in(folder)) {
    const std::string why = remove_file(entry.file, Depth::subfolder);
    if (!why.empty()) throw output_error(entry.file, "cannot remove this checkpoint of an earlier run: " + why);
  }
  remove_left_over(folder);
  std::error_code not_empty;
  fs::remove(folder, not_empty);
}

Checkpoint read_checkpoint(const fs::path& file, const Communicator& communicator) {
  Checkpoint checkpoint;
  communicator.set_phase("reading a checkpoint");
  communicator.agree([&] {
    const CheckpointIndex index = read_index(file);
    const PieceReader reader(file, index);
    reader.read_whole(checkpoint);
    if (!are_possible(checkpoint.model.clock, checkpoint.position))
      refuse_checkpoint(file, "this checkpoint is damaged: no run has come to its time and step");
    const std::size_t pieces = num_pieces(index);
    for (auto p = static_cast<std::size_t>(communicator.rank()); p < pieces;
         p += static_cast<std::size_t>(communicator.size())) {
      Records piece = reader.records(p);
      if (!belong_together(piece))
        refuse_checkpoint(file, "this checkpoint is damaged: its records contradict each other");
      merge(checkpoint.mine, std::move(piece));
    }
  });
  return checkpoint;
}

}  // namespace breccia
