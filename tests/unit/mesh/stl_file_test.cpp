#include "mesh/stl_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "mesh/geometry.hpp"
#include "mesh/gmsh_reader.hpp"
#include "sample_meshes.hpp"

namespace breccia::stl_file_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Corner = std::array<int, 3>;
using Triangles = std::vector<std::array<Corner, 3>>;

/// The twelve triangles of a box, which face outwards; or inwards; or whose first face is cut along its other diagonal.
Triangles box(const Corner& lower, const Corner& upper, bool inwards = false, bool other_diagonal = false) {
  constexpr std::array<std::array<int, 4>, 6> kFaces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  const auto corner = [&](int i) {
    return Corner{(i & 1) != 0 ? upper[0] : lower[0], (i & 2) != 0 ? upper[1] : lower[1],
                  (i & 4) != 0 ? upper[2] : lower[2]};
  };
  Triangles made;
  for (std::size_t f = 0; f < 6; ++f) {
    std::array<int, 4> q = kFaces[f];
    if (f == 0 && other_diagonal) std::rotate(q.begin(), q.begin() + 1, q.end());
    for (std::array<int, 3> t : {std::array{q[0], q[1], q[2]}, std::array{q[0], q[2], q[3]}}) {
      if (inwards) std::swap(t[1], t[2]);
      made.push_back({corner(t[0]), corner(t[1]), corner(t[2])});
    }
  }
  return made;
}

std::string text_of(const std::string& name, const Triangles& triangles) {
  std::string text = "solid" + (name.empty() ? "" : " " + name) + "\n";
  for (const auto& triangle : triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const Corner& x : triangle)
      text += "vertex " + std::to_string(x[0]) + " " + std::to_string(x[1]) + " " + std::to_string(x[2]) + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::string capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::string binary_of(const std::string& heading, const Triangles& triangles) {
  std::string bytes = heading;
  bytes.resize(80, ' ');
  const auto add = [&](const auto& value) {
    std::array<char, sizeof value> raw{};
    std::memcpy(raw.data(), &value, sizeof value);
    bytes.append(raw.data(), raw.size());
  };
  add(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    for (int a = 0; a < 3; ++a) add(0.0f);
    for (const Corner& x : triangle)
      for (const int number : x) add(static_cast<float>(number));
    add(std::uint16_t{0});
  }
  return bytes;
}

const Triangles kBox = box({0, 0, 0}, {3, 1, 1});

// --- Spellings
// -----------------------------------------------------------------------------------------------------

struct Spelling {
  const char* name;
  std::string content;
  std::string solid;
};
void PrintTo(const Spelling& one, std::ostream* stream) { *stream << one.name; }

class StlSpellings : public testing::TestWithParam<Spelling> {};

TEST_P(StlSpellings, GiveTheSameBox) {
  const fs::path file =
      test::write_file(test::scratch_folder(std::string("stl_") + GetParam().name) / "box.stl", GetParam().content);
  const StlFile read = read_stl(file);
  EXPECT_EQ(read.surface.points.size(), 8U);
  EXPECT_EQ(read.surface.triangles.size(), 12U);
  EXPECT_THAT(read.names, ElementsAre(GetParam().solid));
  EXPECT_EQ(take_apart(read.surface, 0.7).fault, "");
}

const std::string kText = text_of("box", kBox);
const Spelling kSpellings[] = {
    {"Plain", kText, "box"},
    {"Capitals", capitals(kText), "BOX"},
    {"Mixed", replaced(replaced(kText, "facet normal", "Facet Normal"), "solid", "Solid"), "box"},
    {"Indented", replaced(replaced(kText, "\n", "\n\t  "), "vertex ", "vertex     "), "box"},
    {"BlankLines", replaced(kText, "\n", "\n\n \n"), "box"},
    {"CarriageReturns", replaced(kText, "\n", "\r\n"), "box"},
    {"OldMacintosh", replaced(kText, "\n", "\r"), "box"},
    {"ByteOrderMark", "\xef\xbb\xbf" + kText, "box"},
    {"BlanksBefore", "\n  " + kText, "box"},
    {"NoName", text_of("", kBox), ""},
    {"NameWithBlanks", text_of("Part 7 (of 9), v2", kBox), "Part 7 (of 9), v2"},
    {"NameOfAccents", text_of("Gew\xc3\xb6lbe", kBox), "Gew\xc3\xb6lbe"},
    {"LongName", text_of(std::string(300, 'n'), kBox), std::string(300, 'n')},
    {"VeryLongName", text_of(std::string(70000, 'n'), kBox), std::string(70000, 'n')},
    {"OneLine", replaced(kText, "\n", " "), "box"},
    {"NoEndsolid", kText.substr(0, kText.find("endsolid")), "box"},
    {"NoSolid", kText.substr(kText.find("facet")), ""},
    {"EndsInTwoWords", replaced(replaced(kText, "endloop", "end loop"), "endfacet", "end facet"), "box"},
    {"Exponents", replaced(kText, "vertex 3 ", "vertex +3.0000E+00 "), "box"},
    {"FortranExponents", replaced(kText, "vertex 3 ", "vertex 0.3D+01 "), "box"},
    {"NotANumberNormals", replaced(kText, "normal 0 0 0", "normal nan nan -nan(ind)"), "box"},
    {"NoNormals", replaced(kText, "facet normal 0 0 0", "facet"), "box"},
    {"Degenerate",
     replaced(kText, "endsolid",
              "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 0\n"
              "vertex 3 1 1\nendloop\nendfacet\nendsolid"),
     "box"},
    {"Rounded", replaced(kText, "vertex 3 1 1", "vertex 3.00000001 1 0.99999999"), "box"},
    {"Binary", binary_of("made by hand", kBox), ""},
    {"BinarySolid", binary_of("solid box", kBox), ""},
    {"BinarySolidFacet", binary_of("solid box facet normal 1 0 0", kBox), ""},
    {"BinaryWithMore", binary_of("x", kBox) + "made by", ""},
};

INSTANTIATE_TEST_SUITE_P(Spellings, StlSpellings, testing::ValuesIn(kSpellings),
                         [](const auto& one) { return std::string(one.param.name); });

struct Damage {
  const char* name;
  std::string content;
  const char* stated;
};
void PrintTo(const Damage& one, std::ostream* stream) { *stream << one.name; }

class DamagedStl : public testing::TestWithParam<Damage> {};

TEST_P(DamagedStl, IsRefusedWithItsLine) {
  const fs::path file =
      test::write_file(test::scratch_folder(std::string("stl_bad_") + GetParam().name) / "bad.stl", GetParam().content);
  try {
    (void)read_stl(file);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("bad.stl"), HasSubstr(GetParam().stated)));
  }
}

const Damage kDamages[] = {
    {"Cut", kText.substr(0, kText.size() / 2), "is cut off"},
    {"Comma", replaced(kText, "vertex 3 ", "vertex 3,5 "), "bad.stl:18: mesh.file: a number has a comma"},
    {"Word", replaced(kText, "vertex 3 1 1", "vertex 3 one 1"), "is no number; allowed: x y z; given: one"},
    {"Infinite", replaced(kText, "vertex 3 1 1", "vertex 3 inf 1"), "is not finite"},
    {"TooLarge", replaced(kText, "vertex 3 1 1", "vertex 3 1e999 1"), "is not finite"},
    {"FourCorners", replaced(kText, "endloop", "vertex 0 0 9\nendloop"), "a facet has more than three corners"},
    {"TwoCorners", replaced(kText, "vertex 3 1 1\n", ""), "allowed: three corners"},
    {"OtherText", "solid box\nhello facet\n", "is no STL text here; allowed: solid, facet or endsolid"},
    {"WideCharacters", "\xff\xfes\0o\0l\0i\0d\0", "16-bit characters"},
    {"Empty", "solid box\nendsolid box\n", "holds no triangle"},
    {"BinaryCut", binary_of("x", kBox).substr(0, 400),
     "is no STL file, or it is cut off: 400 bytes where 12 triangles"},
    {"NoStl", "hello", "is no STL file"},
};

INSTANTIATE_TEST_SUITE_P(Damages, DamagedStl, testing::ValuesIn(kDamages),
                         [](const auto& one) { return std::string(one.param.name); });

// --- Solids that touch, and solids inside others
// -----------------------------------------------------------------------------------------------------

struct Read {
  FinishedMesh made;
  std::string refusal;
};

Read read(const std::string& name, const std::string& content, bool glue) {
  GmshSource source;
  source.file = test::write_file(test::scratch_folder("stl_" + name) / "solids.stl", content);
  source.glue = glue;
  source.size = 3;
  source.time_limit = 120;
  Read result;
  try {
    result.made = read_gmsh(source);
  } catch (const InputError& error) {
    result.refusal = error.what();
  }
  return result;
}

double volume_of(const Mesh& mesh, Index group) {
  double sum = 0;
  for (Index e = 0; e < mesh.num_elements(); ++e) {
    if (mesh.element_group[static_cast<std::size_t>(e)] != group) continue;
    const auto x = geometry::corners_of(mesh, e);
    sum += geometry::tetra_volume(x[0], x[1], x[2], x[3]);
  }
  return sum;
}

/// Nodes that elements of both groups have.
int shared_nodes(const Mesh& mesh) {
  std::vector<int> groups(mesh.nodes.size(), 0);
  for (Index e = 0; e < mesh.num_elements(); ++e)
    for (const Index node : mesh.elements[static_cast<std::size_t>(e)])
      groups[static_cast<std::size_t>(node)] |= 1 << mesh.element_group[static_cast<std::size_t>(e)];
  return static_cast<int>(std::count(groups.begin(), groups.end(), 3));
}

constexpr double kRoundOff = 1e-9;

TEST(StlSolids, ThatShareAFaceAreTwoVolumesAndJoinedWithGlue) {
  const Triangles left = box({0, 0, 0}, {10, 10, 10}), right = box({10, 0, 0}, {20, 10, 10});
  for (const bool one_name : {false, true}) {
    const std::string text = one_name ? text_of("both",
                                                [&] {
                                                  Triangles all = left;
                                                  all.insert(all.end(), right.begin(), right.end());
                                                  return all;
                                                }())
                                      : text_of("a", left) + text_of("b", right);
    for (const bool glue : {false, true}) {
      const auto [made, refusal] = read("touch", text, glue);
      ASSERT_EQ(refusal, "");
      EXPECT_THAT(made.mesh.volume_groups, one_name ? ElementsAre("both", "both_2") : ElementsAre("a", "b"));
      EXPECT_NEAR(volume_of(made.mesh, 0), 1000, 1000 * kRoundOff);
      EXPECT_NEAR(volume_of(made.mesh, 1), 1000, 1000 * kRoundOff);
      EXPECT_EQ(shared_nodes(made.mesh) > 0, glue);
    }
  }
}

TEST(StlSolids, ThatShareAFaceCutInOtherTrianglesAreReadAndNotGlued) {
  const std::string text =
      text_of("a", box({0, 0, 0}, {10, 10, 10})) + text_of("b", box({10, 0, 0}, {20, 10, 10}, false, true));
  const auto [made, refusal] = read("mismatch", text, false);
  ASSERT_EQ(refusal, "");
  EXPECT_NEAR(volume_of(made.mesh, 0), 1000, 1000 * kRoundOff);
  EXPECT_NEAR(volume_of(made.mesh, 1), 1000, 1000 * kRoundOff);
  EXPECT_EQ(shared_nodes(made.mesh), 0);
  EXPECT_THAT(read("mismatch", text, true).refusal,
              AllOf(HasSubstr("touch along a face that each cuts into other triangles"), HasSubstr("as STEP")));
}

TEST(StlSolids, ThatTouchAtAnEdgeOrAPointAreTwoVolumes) {
  for (const int z : {0, 10}) {
    const auto [made, refusal] = read(
        "edge", text_of("a", box({0, 0, 0}, {10, 10, 10})) + text_of("b", box({10, 10, z}, {20, 20, z + 10})), false);
    ASSERT_EQ(refusal, "");
    EXPECT_NEAR(volume_of(made.mesh, 0), 1000, 1000 * kRoundOff);
    EXPECT_NEAR(volume_of(made.mesh, 1), 1000, 1000 * kRoundOff);
  }
}

TEST(StlSolids, InsideOthersAreCutOutOfThemAndHolesAreNamed) {
  const std::string outer = text_of("matrix", box({0, 0, 0}, {12, 12, 12}));
  const auto [inclusion, refused] = read("inside", outer + text_of("grain", box({3, 3, 3}, {9, 9, 9})), true);
  ASSERT_EQ(refused, "");
  EXPECT_THAT(inclusion.mesh.volume_groups, ElementsAre("matrix", "grain"));
  EXPECT_NEAR(volume_of(inclusion.mesh, 0), 1728 - 216, 1728 * kRoundOff);
  EXPECT_NEAR(volume_of(inclusion.mesh, 1), 216, 1728 * kRoundOff);
  EXPECT_GT(shared_nodes(inclusion.mesh), 0);
  EXPECT_THAT(inclusion.report.notes, ElementsAre(HasSubstr("\"grain\" lies inside \"matrix\" and is cut out of it")));

  const auto [hollow, no] = read("hollow", outer + text_of("hole", box({3, 3, 3}, {9, 9, 9}, true)), false);
  ASSERT_EQ(no, "");
  EXPECT_THAT(hollow.mesh.volume_groups, ElementsAre("matrix"));
  EXPECT_NEAR(volume_of(hollow.mesh, 0), 1728 - 216, 1728 * kRoundOff);
  EXPECT_THAT(hollow.report.notes, ElementsAre(HasSubstr("faces inwards: it is a hole")));

  const auto [filled, none] = read(
      "filled", outer + text_of("hole", box({3, 3, 3}, {9, 9, 9}, true)) + text_of("grain", box({3, 3, 3}, {9, 9, 9})),
      true);
  ASSERT_EQ(none, "");
  EXPECT_THAT(filled.mesh.volume_groups, ElementsAre("matrix", "grain"));
  EXPECT_NEAR(volume_of(filled.mesh, 0), 1728 - 216, 1728 * kRoundOff);
  EXPECT_NEAR(volume_of(filled.mesh, 1), 216, 1728 * kRoundOff);
  EXPECT_GT(shared_nodes(filled.mesh), 0);
}

TEST(StlSolids, TrianglesThatStandTwiceAreReadOnceWithAWord) {
  Triangles twice = box({0, 0, 0}, {10, 10, 10});
  twice.push_back(twice.front());
  const auto [made, refusal] = read("twice", text_of("a", twice), false);
  ASSERT_EQ(refusal, "");
  EXPECT_THAT(made.report.notes, ElementsAre(HasSubstr("1 triangle stands in the file twice")));
}

}  // namespace
}  // namespace breccia::stl_file_test
