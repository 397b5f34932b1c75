#include "output/frames/vtkhdf_sink.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "output/folder/folder_check.hpp"
#include "output/folder/folder_tree.hpp"
#include "output/frames/frame_fields.hpp"
#include "output/frames/vtkhdf_image.hpp"
#include "run_folder/series.hpp"
#include "system/atomic_file.hpp"
#include "system/regular_file.hpp"

namespace breccia {
namespace {

template <class Part>
GridView view_of(CellKind kind, const std::vector<double>& points, const Part& part) {
  GridView grid{.kind = kind, .points = points, .arrays = {}};
  for_each_array(part, [&](const char* name, const auto& values, int components) {
    grid.arrays.push_back({name, values, components, kept_in_64_bits(name)});
  });
  return grid;
}

GridView view_of(const Frame& frame, const std::string& part) {
  GridView grid = part == "elements" ? view_of(CellKind::tetrahedra, frame.elements.points, frame.elements)
                  : part == "joints" ? view_of(CellKind::triangles, frame.joints.points, frame.joints)
                                     : view_of(CellKind::vertices, frame.contacts.points, frame.contacts);
  grid.time = frame.time;
  grid.step = frame.step;
  return grid;
}

}  // namespace

VtkhdfSink::VtkhdfSink(std::filesystem::path folder, FrameParts parts, Communicator communicator)
    : folder_(std::move(folder)), communicator_(std::move(communicator)) {
  if (parts.elements) series_.push_back({"elements", {}});
  if (parts.joints) series_.push_back({"joints", {}});
  if (parts.contacts) series_.push_back({"contacts", {}});
}

void VtkhdfSink::start(const RunStart& run) {
  if (!run.marks) return;
  keep_frames(static_cast<std::size_t>(run.marks->frames));
}

void VtkhdfSink::mark(OutputMarks& marks) const {
  if (!series_.empty()) marks.frames = std::ssize(series_.front().entries);
}

/// The frames of an index.
std::vector<VtkhdfSink::Entry> VtkhdfSink::listed(const std::string& part) const {
  std::vector<Entry> entries;
  const std::filesystem::path index = folder_ / (part + ".hdf.series");
  const run_folder::Series series = run_folder::parse_series(regular_content(index, Depth::subfolder).value_or(""));
  bool is_ours = series.refused.empty();
  for (const run_folder::SeriesFrame& frame : series.frames) {
    is_ours = is_ours && is_frame_file(frame.name);
    entries.push_back({frame.name, frame.time});
  }
  if (!is_ours) throw output_error(index, "this is no index of frames");
  return entries;
}

/// Keeps the first frames of the indices and removes those that the indices name behind them: first from the indices,
/// then the files.
void VtkhdfSink::keep_frames(std::size_t count) {
  std::vector<std::string> later;
  for (Series& part : series_) {
    part.entries = listed(part.part);
    if (part.entries.size() < count)
      throw output_error(folder_ / (part.part + ".hdf.series"),
                         "this index of frames has lost some that were written before the checkpoint");
    for (std::size_t i = count; i < part.entries.size(); ++i) later.push_back(part.entries[i].file);
    part.entries.resize(count);
  }
  if (!communicator_.is_root()) return;
  for (const Series& part : series_)
    write_file_atomically(folder_ / (part.part + ".hdf.series"), index_text(part), Depth::subfolder);
  for (const std::string& file : later) (void)remove_file(folder_ / file, Depth::subfolder);
}

void VtkhdfSink::frame(const Frame& frame) {
  std::vector<Series> series = series_;
  for (Series& part : series)
    part.entries.push_back({fmt::format("{}_{:06}.vtkhdf", part.part, frame.number), frame.time});
  if (communicator_.size() == 1) {
    write_alone(frame, series);
  } else {
    write_together(frame, series);
  }
  series_ = std::move(series);
}

void VtkhdfSink::write_alone(const Frame& frame, const std::vector<Series>& series) const {
  std::vector<std::vector<std::byte>> images;
  for (const Series& part : series) images.push_back(vtkhdf_image(view_of(frame, part.part)));
  publish(series, images);
}

void VtkhdfSink::write_together(const Frame& frame, const std::vector<Series>& series) const {
  try {
    for (const Series& part : series) write_vtkhdf_temporary(newest(part), view_of(frame, part.part), communicator_);
  } catch (...) {  // the same on all ranks
    for (const Series& part : series) {
      if (communicator_.is_root()) (void)remove_file(temporary_of(newest(part)), Depth::subfolder);
    }
    throw;
  }
  communicator_.agree([&] {
    if (communicator_.is_root()) publish(series, {});
  });
}

void VtkhdfSink::publish(const std::vector<Series>& series, const std::vector<std::vector<std::byte>>& images) const {
  std::vector<std::string> indices;
  std::vector<FileContent> files;  // first the frames, then the indices that name them
  for (std::size_t i = 0; i < series.size(); ++i) {
    indices.push_back(index_text(series[i]));
    files.push_back({newest(series[i]), {}});
    if (!images.empty()) files.back().content = images[i];
  }
  for (std::size_t i = 0; i < series.size(); ++i) {
    files.push_back({folder_ / (series[i].part + ".hdf.series"), std::as_bytes(std::span(indices[i]))});
  }
  write_files_atomically(files, Depth::subfolder);
}

std::string VtkhdfSink::index_text(const Series& series) {
  nlohmann::ordered_json index;
  index["file-series-version"] = "1.0";
  index["files"] = nlohmann::ordered_json::array();
  for (const Entry& entry : series.entries) index["files"].push_back({{"name", entry.file}, {"time", entry.time}});
  return index.dump(1) + "\n";
}

}  // namespace breccia
