#pragma once

#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.hpp"
#include "mesh/geometry.hpp"
#include "mesh/gmsh_reader.hpp"
#include "mesh/raster.hpp"

namespace breccia::test {

/// Folder of this process, removed at its end: tests run side by side.
struct ScratchFolder {
  ScratchFolder()
      : path(std::filesystem::temp_directory_path() / ("breccia_mesh_test_" + std::to_string(::getpid()))) {}
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::filesystem::path path;
};

/// An empty folder inside it.
inline std::filesystem::path scratch_folder(const std::string& name) {
  static const ScratchFolder root;
  const auto folder = root.path / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::filesystem::path write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

/// Two boxes of 1 x 1 x 1 and 0.5 x 1 x 1 m sharing the face x = 1, meshed by gmsh's Delaunay algorithm.
inline constexpr const char* kTwoBoxes = R"(SetFactory("OpenCASCADE");
DefineConstant[ size = 0.3 ];
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {1, 0, 0, 0.5, 1, 1};
BooleanFragments{ Volume{1, 2}; Delete; }{}
MeshSize{:} = size;
Physical Volume("left", 1) = {1};
Physical Volume("right", 2) = {2};
e = 1e-4;
Physical Surface("interface", 3) = Surface In BoundingBox {1-e, -e, -e, 1+e, 1+e, 1+e};
Physical Surface("bottom", 4) = Surface In BoundingBox {-e, -e, -e, 2, 1+e, e};
)";

/// Unstructured mesh of the two boxes.
inline FinishedMesh two_boxes(const std::string& name, double size, bool glue) {
  GmshSource source;
  source.file = write_file(scratch_folder(name) / "two_boxes.geo", kTwoBoxes);
  source.parameters["size"] = size;
  source.glue = glue;
  return read_gmsh(source);
}

inline FinishedMesh raster_box(std::array<int, 3> cells, std::array<int, 3> boxes = {1, 1, 1}) {
  return make_raster(
      {.cells = cells, .cell_size = Vec3(1.0, 0.75, 1.25), .boxes = boxes, .gap = Vec3(0.5, 0.25, 0.125)});
}

/// The message that refuses a file; "accepted" where it is read.
inline std::string refusal_of(const GmshSource& source) {
  try {
    (void)read_gmsh(source);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// Of all elements, m3.
inline double volume_of(const Mesh& mesh) {
  double sum = 0;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    const auto x = geometry::corners_of(mesh, e);
    sum += geometry::tetra_volume(x[0], x[1], x[2], x[3]);
  }
  return sum;
}

inline Vec3 node_of(const Mesh& mesh, Index element, int corner) {
  const Index node = mesh.elements[static_cast<std::size_t>(element)][static_cast<std::size_t>(corner)];
  return mesh.nodes[static_cast<std::size_t>(node)];
}

}  // namespace breccia::test
