#include "output/vtkhdf_sink.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "output/atomic_file.hpp"
#include "output/frame_fields.hpp"
#include "output/vtkhdf_image.hpp"

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
  for (Series& part : series_) part.entries = entries_of(part.part, static_cast<std::size_t>(run.marks->frames));
  if (communicator_.is_root()) drop_later_frames();
}

void VtkhdfSink::mark(OutputMarks& marks) const {
  if (!series_.empty()) marks.frames = std::ssize(series_.front().entries);
}

/// The first frames of an index.
std::vector<VtkhdfSink::Entry> VtkhdfSink::entries_of(const std::string& part, std::size_t count) const {
  std::vector<Entry> entries;
  if (count == 0) return entries;
  const std::filesystem::path index = folder_ / (part + ".hdf.series");
  std::ifstream file(index);
  const auto json = nlohmann::json::parse(file, nullptr, /*allow_exceptions=*/false);
  const auto listed = json.is_object() ? json.value("files", nlohmann::json::array()) : nlohmann::json::array();
  if (!listed.is_array() || listed.size() < count)
    throw output_error(index, "this index of frames has lost some that were written before the checkpoint");
  for (std::size_t i = 0; i < count; ++i) {
    if (!listed[i].is_object() || !listed[i].contains("name") || !listed[i]["name"].is_string() ||
        !listed[i].contains("time") || !listed[i]["time"].is_number())
      throw output_error(index, "this is no index of frames");
    entries.push_back({listed[i]["name"].get<std::string>(), listed[i]["time"].get<double>()});
  }
  return entries;
}

/// First from the indices, then the files.
void VtkhdfSink::drop_later_frames() const {
  std::set<std::string> kept;
  for (const Series& part : series_) {
    write_file_atomically(folder_ / (part.part + ".hdf.series"), index_text(part));
    for (const Entry& entry : part.entries) kept.insert(entry.file);
  }
  std::error_code error;
  std::vector<std::filesystem::path> later;
  for (const auto& file : std::filesystem::directory_iterator(folder_, error)) {
    const std::string name = file.path().filename().string();
    if (name.ends_with(".vtkhdf") && !kept.contains(name)) later.push_back(file.path());
  }
  for (const std::filesystem::path& file : later) std::filesystem::remove(file, error);
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
    std::error_code ignored;
    for (const Series& part : series) {
      if (communicator_.is_root()) std::filesystem::remove(temporary_of(newest(part)), ignored);
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
  write_files_atomically(files);
}

std::string VtkhdfSink::index_text(const Series& series) {
  nlohmann::ordered_json index;
  index["file-series-version"] = "1.0";
  index["files"] = nlohmann::ordered_json::array();
  for (const Entry& entry : series.entries) index["files"].push_back({{"name", entry.file}, {"time", entry.time}});
  return index.dump(1) + "\n";
}

}  // namespace breccia
