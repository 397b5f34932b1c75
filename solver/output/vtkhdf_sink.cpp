#include "output/vtkhdf_sink.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
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
