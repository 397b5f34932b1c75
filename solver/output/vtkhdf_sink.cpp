#include "output/vtkhdf_sink.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "output/atomic_file.hpp"
#include "output/vtkhdf_image.hpp"

namespace breccia {
namespace {

GridView view_of(const Frame::Elements& elements) {
  return {.kind = CellKind::tetrahedra,
          .points = elements.points,
          .arrays = {{"id", elements.id},
                     {"body", elements.body},
                     {"material", elements.material},
                     {"rank", elements.rank},
                     {"fragment", elements.fragment},
                     {"stress", elements.stress, 6},
                     {"von_mises", elements.von_mises},
                     {"principal", elements.principal, 3},
                     {"velocity", elements.velocity, 3},
                     {"displacement", elements.displacement, 3}}};
}

GridView view_of(const Frame::Joints& joints) {
  return {.kind = CellKind::triangles,
          .points = joints.points,
          .arrays = {{"id", joints.id},
                     {"damage", joints.damage},
                     {"mode", joints.mode},
                     {"opening", joints.opening},
                     {"slip", joints.slip},
                     {"broken", joints.broken}}};
}

GridView view_of(const Frame::Contacts& contacts) {
  return {.kind = CellKind::vertices,
          .points = contacts.points,
          .arrays = {{"force", contacts.force, 3}, {"body", contacts.body}, {"other_body", contacts.other_body}}};
}

GridView view_of(const Frame& frame, const std::string& part) {
  GridView grid = part == "elements" ? view_of(frame.elements)
                  : part == "joints" ? view_of(frame.joints)
                                     : view_of(frame.contacts);
  grid.time = frame.time;
  grid.step = frame.step;
  return grid;
}

}  // namespace

VtkhdfSink::VtkhdfSink(std::filesystem::path folder, FrameParts parts) : folder_(std::move(folder)) {
  if (parts.elements) series_.push_back({"elements", {}});
  if (parts.joints) series_.push_back({"joints", {}});
  if (parts.contacts) series_.push_back({"contacts", {}});
}

void VtkhdfSink::frame(const Frame& frame) {
  for (const Series& series : series_) {
    const std::string name = fmt::format("{}_{:06}.vtkhdf", series.part, frame.number);
    write_file_atomically(folder_ / name, vtkhdf_image(view_of(frame, series.part)));
  }
  for (Series& series : series_) {
    series.entries.push_back({fmt::format("{}_{:06}.vtkhdf", series.part, frame.number), frame.time});
    write_index(series);
  }
}

void VtkhdfSink::write_index(const Series& series) const {
  nlohmann::ordered_json index;
  index["file-series-version"] = "1.0";
  index["files"] = nlohmann::ordered_json::array();
  for (const Entry& entry : series.entries) index["files"].push_back({{"name", entry.file}, {"time", entry.time}});
  write_file_atomically(folder_ / (series.part + ".hdf.series"), index.dump(1) + "\n");
}

}  // namespace breccia
