#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "mesh/geometry.hpp"
#include "mesh/gmsh_reader.hpp"
#include "sample_meshes.hpp"
#include "support/replaced.hpp"

// Rows of a table of files as other programs write them: each is read with its volume and groups, or refused with a
// line that helps.

namespace breccia::test {

using Names = std::vector<std::string>;
constexpr double kWritten = 1e-6;  // of coordinates of eight letters in a fixed field
constexpr const char* kCorners = "read by their corners";

struct Row {
  std::string name;
  std::string extension;
  std::function<std::string()> content;
  double volume = 0;  ///< m3; 0: refused
  Names volumes, surfaces, nodes;
  std::string stated;  ///< in the refusal, or among the notes
  bool glue = true;
};
inline void PrintTo(const Row& row, std::ostream* stream) { *stream << row.name << row.extension; }

inline std::function<std::string()> text(const std::string& given) {
  return [given] { return given; };
}

/// Reads the file of a row and compares.
inline void check_row(const Row& row) {
  using testing::AllOf;
  using testing::HasSubstr;
  using testing::Not;
  GmshSource source;
  source.file = write_file(scratch_folder("foreign_" + row.name) / (row.name + row.extension), row.content());
  source.glue = row.glue;
  source.time_limit = 120;
  FinishedMesh made;
  std::string refusal;
  try {
    made = read_gmsh(source);
  } catch (const InputError& error) {
    refusal = error.what();
  }
  if (row.volume == 0) {
    EXPECT_THAT(refusal, AllOf(HasSubstr(row.name + row.extension), HasSubstr(row.stated)));
    EXPECT_THAT(refusal, AllOf(Not(HasSubstr("::")), Not(HasSubstr("what()"))));
    return;
  }
  ASSERT_EQ(refusal, "");
  double volume = 0;
  for (Index e = 0; e < made.mesh.num_elements(); ++e) {
    const auto x = geometry::corners_of(made.mesh, e);
    volume += geometry::tetra_volume(x[0], x[1], x[2], x[3]);
  }
  EXPECT_NEAR(volume, row.volume, kWritten * row.volume);
  const auto sorted = [](Names names) {
    std::sort(names.begin(), names.end());
    return names;
  };
  if (!row.volumes.empty()) {
    EXPECT_EQ(sorted(made.mesh.volume_groups), sorted(row.volumes));
  }
  if (row.extension.find("st") == std::string::npos && row.extension != ".brep") {
    EXPECT_EQ(sorted(made.mesh.surface_groups), sorted(row.surfaces));
    EXPECT_EQ(sorted(made.mesh.node_groups), sorted(row.nodes));
  }
  std::string notes;
  for (const std::string& note : made.report.notes) notes += note + "\n";
  EXPECT_THAT(notes, HasSubstr(row.stated));
  EXPECT_EQ(notes.empty(), row.stated.empty()) << notes;
}

}  // namespace breccia::test
