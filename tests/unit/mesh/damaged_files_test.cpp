#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "base/error.hpp"
#include "mesh/geometry.hpp"
#include "mesh/gmsh_reader.hpp"
#include "mesh/msh_scan.hpp"
#include "mesh/step_scan.hpp"
#include "sample_meshes.hpp"
#include "support/replaced.hpp"

namespace breccia::damaged_files_test {
namespace {

namespace fs = std::filesystem;
using test::replaced;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string refusal_of(const fs::path& file) {
  GmshSource source;
  source.file = file;
  source.time_limit = 120;
  try {
    (void)read_gmsh(source);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// --- Mesh files whose counts are not their content
// -------------------------------------------------------------------------------------

/// Two tetrahedra, each a volume of its own.
constexpr const char* kTwo41 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"a\"\n3 2 \"b\"\n$EndPhysicalNames\n"
    "$Entities\n0 0 0 2\n1 0 0 0 1 1 1 1 1 0\n2 0 0 0 1 1 1 1 2 0\n$EndEntities\n"
    "$Nodes\n1 5 1 5\n3 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n"
    "$Elements\n2 2 1 2\n3 1 4 1\n1 1 2 3 4\n3 2 4 1\n2 2 3 4 5\n$EndElements\n";
constexpr const char* kTwo40 =
    "$MeshFormat\n4 0 8\n$EndMeshFormat\n$Entities\n0 0 0 2\n1 0 0 0 1 1 1 1 1 0\n2 0 0 0 1 1 1 1 2 0\n$EndEntities\n"
    "$Nodes\n1 5\n1 3 0 5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n$EndNodes\n"
    "$Elements\n2 2\n1 3 4 1\n1 1 2 3 4\n2 3 4 1\n2 2 3 4 5\n$EndElements\n";
constexpr const char* kTwo22 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"a\"\n3 2 \"b\"\n$EndPhysicalNames\n"
    "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n$EndNodes\n"
    "$Elements\n2\n1 4 2 1 1 1 2 3 4\n2 4 2 2 2 2 3 4 5\n$EndElements\n";

struct Miscount {
  const char* name;
  const char* whole;
  const char* from;
  const char* to;
  const char* stated;
};
void PrintTo(const Miscount& one, std::ostream* stream) { *stream << one.name; }

class MeshFilesWithAMiscount : public testing::TestWithParam<Miscount> {};

TEST_P(MeshFilesWithAMiscount, AreRefusedWithTheSection) {
  const Miscount& one = GetParam();
  const fs::path folder = test::scratch_folder(std::string("miscount_") + one.name);
  ASSERT_EQ(refusal_of(test::write_file(folder / "whole.msh", one.whole)), "accepted");
  EXPECT_THAT(refusal_of(test::write_file(folder / "damaged.msh", replaced(one.whole, one.from, one.to))),
              AllOf(HasSubstr("damaged.msh"), HasSubstr(one.stated)));
}

const Miscount kMiscounts[] = {
    {"FewerBlocks41", kTwo41, "\n2 2 1 2\n", "\n1 1 1 1\n", "$Elements: it holds more than its heading states"},
    {"MoreBlocks41", kTwo41, "\n2 2 1 2\n", "\n3 3 1 2\n", "$Elements: it holds less than its heading states"},
    {"Total41", kTwo41, "\n2 2 1 2\n", "\n2 7 1 2\n", "$Elements: its blocks hold 2, and its heading states 7"},
    {"FewerInABlock41", kTwo41, "3 1 4 1\n1 1 2", "3 1 4 0\n1 1 2", "$Elements: "},
    {"NoEnd41", kTwo41, "$EndElements\n", "", "$Elements: the file ends without $EndElements"},
    {"NoEndOfNodes41", kTwo41, "$EndNodes\n", "", "$Nodes: $Elements stands where it ends"},
    {"NodesTotal41", kTwo41, "\n1 5 1 5\n", "\n1 6 1 5\n", "$Nodes: its blocks hold 5, and its heading states 6"},
    {"FewerNodes41", kTwo41, "3 1 0 5\n", "3 1 0 4\n", "$Nodes: "},
    {"FewerEntities41", kTwo41, "$Entities\n0 0 0 2", "$Entities\n0 0 0 1", "$Entities: it holds more"},
    {"MoreNames41", kTwo41, "Names\n2\n", "Names\n3\n", "$PhysicalNames: it holds less"},
    {"FewerNames41", kTwo41, "Names\n2\n", "Names\n1\n", "$PhysicalNames: it holds more"},
    {"DecimalComma41", kTwo41, "0 0 1\n1 1 1", "0 0 1\n1,0 1 1", "\"1,0\" stands where a number is expected"},
    {"FewerBlocks40", kTwo40, "$Elements\n2 2\n", "$Elements\n1 1\n", "$Elements: it holds more"},
    {"Total40", kTwo40, "$Elements\n2 2\n", "$Elements\n2 3\n", "$Elements: its blocks hold 2"},
    {"FewerElements22", kTwo22, "$Elements\n2\n", "$Elements\n1\n", "$Elements: it holds more"},
    {"MoreElements22", kTwo22, "$Elements\n2\n", "$Elements\n3\n", "$Elements: it holds less"},
    {"FewerNodes22", kTwo22, "$Nodes\n5\n", "$Nodes\n4\n", "$Nodes: it holds more"},
    {"NoEnd22", kTwo22, "$EndElements\n", "", "$Elements: the file ends without $EndElements"},
};

INSTANTIATE_TEST_SUITE_P(Miscounts, MeshFilesWithAMiscount, testing::ValuesIn(kMiscounts),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(MshScan, FindsNoFaultInWhatGmshWritesInAnyFormat) {
  const fs::path folder = test::scratch_folder("msh_scan");
  const fs::path geo = test::write_file(folder / "model.geo", test::kTwoBoxes);
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::open(geo.string());
  gmsh::model::mesh::generate(3);
  for (const int order : {1, 2}) {
    gmsh::model::mesh::setOrder(order);
    for (const double parametric : {0, 1})
      for (const double version : {2.2, 4.0, 4.1})
        for (const int binary : {0, 1}) {
          if (version == 4.0 && binary == 1) continue;  // gmsh writes none
          gmsh::option::setNumber("Mesh.SaveParametric", parametric);
          gmsh::option::setNumber("Mesh.MshFileVersion", version);
          gmsh::option::setNumber("Mesh.Binary", binary);
          gmsh::write((folder / "whole.msh").string());
          const std::vector<Problem> faults = msh_faults(folder / "whole.msh");
          EXPECT_TRUE(faults.empty()) << version << ' ' << binary << ' ' << faults.front().text();
        }
  }
  gmsh::finalize();
}

// --- STEP files with damaged references
// -------------------------------------------------------------------------------------

constexpr double kVolume = 1e-9 * (60 * 20 * 10 + 10 * 10 * 30), kRoundOff = 1e-9;

fs::path two_boxes_step(const fs::path& folder) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::occ::addBox(0, 0, 0, 60, 20, 10);
  gmsh::model::occ::addBox(80, 0, 0, 10, 10, 30);
  gmsh::model::occ::synchronize();
  testing::internal::CaptureStdout();  // OpenCASCADE tells what it writes
  gmsh::write((folder / "whole.step").string());
  (void)testing::internal::GetCapturedStdout();
  gmsh::finalize();
  return folder / "whole.step";
}

TEST(StepScan, CountsTheSolidsAndFindsNoFaultInAWholeFile) {
  const StepScan scan = scan_step(two_boxes_step(test::scratch_folder("step_whole")));
  EXPECT_EQ(scan.solids, 2);
  EXPECT_THAT(scan.problems, IsEmpty());
}

TEST(StepScan, NamesAReferenceThatLeadsNowhere) {
  const fs::path folder = test::scratch_folder("step_scan");
  const StepScan scan = scan_step(test::write_file(
      folder / "a.step", "DATA;\n#1=A('#9 ''#8',#2);/* #7 */\n#2=MANIFOLD_SOLID_BREP('',#3);\n#2=B();\nENDSEC;\n"));
  ASSERT_THAT(scan.problems, SizeIs(2));
  EXPECT_THAT(scan.problems[0].text(), HasSubstr("a.step:3: #2: refers to #3, which the file does not have"));
  EXPECT_THAT(scan.problems[1].text(), HasSubstr("a.step:4: #2: is given twice"));
}

TEST(StepFiles, WithOneReferenceDamagedAreRefusedOrReadWhole) {
  const fs::path folder = test::scratch_folder("step_damaged");
  const std::string whole = text_of(two_boxes_step(folder));
  constexpr int kEvery = 29;  // of the references: about thirty
  int tried = 0, refused = 0, seen = 0;
  for (std::size_t at = whole.find("DATA;"); (at = whole.find('#', at + 1)) != std::string::npos;) {
    const std::size_t end = whole.find_first_not_of("0123456789", at + 1);
    if (++seen % kEvery != 0) continue;
    // Another number of as many digits, as one flipped bit makes it: often one that the file has.
    std::string text = whole;
    text[end - 1] = static_cast<char>('0' + (text[end - 1] - '0' + 1) % 10);
    GmshSource source;
    source.file = test::write_file(folder / "damaged.step", text);
    source.time_limit = 60;
    ++tried;
    try {
      const Mesh mesh = read_gmsh(source).mesh;
      double volume = 0;
      for (Index e = 0; e < mesh.num_elements(); ++e) {
        const auto x = geometry::corners_of(mesh, e);
        volume += geometry::tetra_volume(x[0], x[1], x[2], x[3]);
      }
      EXPECT_EQ(mesh.num_bodies, 2) << text.substr(at - 40, 60);
      EXPECT_GT(volume, 0.5 * kVolume) << text.substr(at - 40, 60);
    } catch (const InputError& error) {
      ++refused;
      EXPECT_THAT(error.what(), testing::Not(AnyOf(HasSubstr("::"), HasSubstr("what()")))) << error.what();
    }
  }
  EXPECT_GT(tried, 20);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace breccia::damaged_files_test
