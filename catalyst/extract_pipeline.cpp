#include "catalyst/extract_pipeline.hpp"

#include <vtkDataArray.h>
#include <vtkTable.h>

#include <functional>

#include "catalyst/whole_file.hpp"
#include "run_folder/csv.hpp"

namespace breccia::insitu {
namespace {

/// Text of what went wrong in `work`, empty when nothing did.
std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

std::string cell_text(vtkDataArray* array, vtkIdType row, int component) {
  if (array->GetDataType() == VTK_DOUBLE) return exact(array->GetComponent(row, component));
  return array->GetVariantValue(row * array->GetNumberOfComponents() + component).ToString();
}

/// Header and rows of a table as lines of CSV.
std::vector<std::string> csv_lines(vtkTable* table) {
  std::vector<std::string> lines(static_cast<std::size_t>(table->GetNumberOfRows()) + 1);
  for (vtkIdType column = 0; column < table->GetNumberOfColumns(); ++column) {
    auto* array = vtkDataArray::SafeDownCast(table->GetColumn(column));
    const int components = array->GetNumberOfComponents();
    for (int component = 0; component < components; ++component) {
      const char* comma = lines[0].empty() ? "" : ",";
      lines[0] +=
          comma + csv_field(array->GetName() + (components == 1 ? std::string() : " " + std::to_string(component)));
      for (std::size_t line = 1; line < lines.size(); ++line)
        lines[line] += comma + cell_text(array, static_cast<vtkIdType>(line) - 1, component);
    }
  }
  return lines;
}

}  // namespace

ExtractPipeline::ExtractPipeline(const Ranks& ranks, int channel, std::filesystem::path folder)
    : ranks_(ranks), channel_(channel), folder_(std::move(folder)) {}

std::uint32_t ExtractPipeline::channels(std::int64_t, double) { return bit(channel_); }

void ExtractPipeline::execute(const Frame& frame, BrecciaRequests&) {
  const auto channel = static_cast<std::size_t>(channel_);
  vtkDataObject* object = frame.channels[channel];
  const std::filesystem::path piece = folder_ / piece_name(object, kChannelNames[channel], frame.step, ranks_.rank());
  std::string error;
  if (ranks_.is_root()) error = error_of([&] { make_folder(piece.parent_path()); });
  ranks_.throw_agreed(error);
  ranks_.throw_agreed(error_of([&] { bytes_ += write_piece(object, piece); }));
  if (ranks_.is_root()) index(frame, object);
}

void ExtractPipeline::index(const Frame& frame, vtkDataObject* object) {
  const std::string name = kChannelNames[static_cast<std::size_t>(channel_)];
  const std::filesystem::path list = folder_ / (name + ".pvd");
  if (!begun_) {
    instants_ = read_pvd(list);
    begun_ = true;
  }
  std::erase_if(instants_, [&](const RecordedInstant& old) { return old.step >= frame.step; });
  const std::string file = instant_name(name, frame.step) + "." + summary_suffix(object);
  bytes_ += replace_file(folder_ / file, summary_text(object, name, frame.step, ranks_.size()), Sync::no);
  instants_.push_back({frame.step, frame.time, file});
  try {
    bytes_ += replace_file(list, pvd_text(instants_));
  } catch (...) {
    instants_.pop_back();
    throw;
  }
}

HistoryPipeline::HistoryPipeline(const Ranks& ranks, std::filesystem::path folder)
    : ranks_(ranks), file_(std::move(folder) / "history.csv") {}

std::uint32_t HistoryPipeline::channels(std::int64_t, double) { return bit(BRECCIA_HISTORY); }

void HistoryPipeline::execute(const Frame& frame, BrecciaRequests&) {
  if (!ranks_.is_root()) return;
  const auto lines = csv_lines(vtkTable::SafeDownCast(frame.channels[BRECCIA_HISTORY]));
  std::string rows;
  for (std::size_t line = 1; line < lines.size(); ++line) rows += lines[line] + '\n';
  if (begun_) {
    bytes_ += append_to_file(file_, rows);
    return;
  }
  make_folder(file_.parent_path());
  const std::string earlier = run_folder::rows_before(file_content(file_), lines[0], frame.step);
  bytes_ += replace_file(file_, lines[0] + '\n' + earlier + rows);
  begun_ = true;
}

}  // namespace breccia::insitu
