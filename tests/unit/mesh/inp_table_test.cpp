#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "foreign_row.hpp"

// Abaqus input files.

namespace breccia::inp_table_test {
namespace {

using test::kCorners;
using test::Names;
using test::replaced;
using test::Row;
using test::text;

/// Two tetrahedra of 1/6 that share a face, of 5 nodes.
const std::string kNodes = "*NODE\n1, 0, 0, 0\n2, 1., 0, 0\n3, 0, 1.0E0, 0\n4, 0, 0, 1\n5, 1, 1, 1\n";
const std::string kPair = kNodes + "*ELEMENT, TYPE=C3D4, ELSET=ALL\n1, 1, 2, 3, 4\n2, 2, 3, 4, 5\n";
constexpr double kPairVolume = 1.0 / 6 + 1.0 / 3;

const std::string kQuadratic =
    "*Node\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,.5,0,0\n6,.5,.5,0\n7,0,.5,0\n8,0,0,.5\n9,.5,0,.5\n10,0,.5,.5\n"
    "*Element, type=C3D10\n7, 1, 2, 3, 4, 5, 6,\n 7, 8, 9, 10\n";

/// As Abaqus/CAE writes a part, an instance and sets of the assembly.
std::string assembly(const std::string& instances) {
  return "*Heading\n** Job name: a\n*Part, name=Part-1\n*Node\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*Element, "
         "type=C3D4\n"
         "1, 1, 2, 3, 4\n*Nset, nset=Set-1, generate\n1, 4, 1\n*Elset, elset=Set-1\n1,\n*Elset, elset=_Surf_S1, "
         "internal\n1\n"
         "*Solid Section, elset=Set-1, material=Rock\n,\n*End Part\n*Assembly, name=Assembly\n" +
         instances +
         "*Nset, nset=foot, instance=Part-1-1\n 1, 2,\n*Elset, elset=_Surf_S1, internal, instance=Part-1-1\n1,\n"
         "*Surface, type=ELEMENT, name=Surf-1\n_Surf_S1, S1\n*End Assembly\n*Material, name=Rock\n*Elastic\n1e9, 0.2\n"
         "*Step, name=Step-1\n*Static\n1, 1\n*End Step\n";
}

std::vector<Row> rows_of_abaqus() {
  const auto bad = [](const std::string& name, const std::string& given, const std::string& stated) {
    return Row{name, ".inp", text(given), 0, {}, {}, {}, stated};
  };
  return {
      {"InpPlain", ".inp", text(kPair), kPairVolume, {"ALL"}, {}, {}, ""},
      {"InpNoSets", ".inp", text(replaced(kPair, ", ELSET=ALL", "")), kPairVolume, {"volume_1"}, {}, {}, ""},
      {"InpSmallLetters",
       ".inp",
       text("*node, nset=n\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*element,type=c3d4,elset=rock\n1,1,2,3,4\n"),
       1.0 / 6,
       {"rock"},
       {},
       {"n"},
       ""},
      {"InpCarriageReturns",
       ".inp",
       [] {
         std::string t = kPair;
         for (std::size_t i = 0; (i = t.find('\n', i)) != std::string::npos; i += 2) t.insert(i, "\r");
         return t;
       },
       kPairVolume,
       {"ALL"},
       {},
       {},
       ""},
      {"InpCapitalName", ".INP", text(kPair), kPairVolume, {"ALL"}, {}, {}, ""},
      {"InpSections",
       ".inp",
       text(kPair + "*ELSET, ELSET=LOW\n1\n*ELSET, ELSET=HIGH\n2\n*SOLID SECTION, ELSET=low, MATERIAL=M\n*SOLID "
                    "SECTION, ELSET=HIGH, MATERIAL=N\n"),
       kPairVolume,
       {"LOW", "HIGH"},
       {},
       {"ALL"},
       ""},
      {"InpPartOfAll",
       ".inp",
       text(replaced(kPair, ", ELSET=ALL", "") + "*ELSET, ELSET=NOTCH\n2\n"),
       kPairVolume,
       {"NOTCH", "rest"},
       {},
       {},
       ""},
      {"InpGenerate",
       ".inp",
       text(kPair +
            "*NSET, NSET=foot, GENERATE\n1, 3\n*NSET, NSET=odd, GENERATE\n1, 5, 2\n*ELSET,ELSET=E,GENERATE\n1,2,1\n"),
       kPairVolume,
       {"E"},
       {},
       {"ALL", "foot", "odd"},
       ""},
      {"InpSetsOfSets",
       ".inp",
       text(kPair + "*NSET, NSET=a\n1, 2,\n3\n*NSET, NSET=b\na, 4\n*NSET, NSET=c, ELSET=ALL\n"),
       kPairVolume,
       {"ALL"},
       {},
       {"a", "b", "c"},
       ""},
      {"InpSurfaces",
       ".inp",
       text(kPair + "*SURFACE, NAME=base, TYPE=ELEMENT\n1, S1\n*SURFACE, NAME=skin\nALL\n*SURFACE, NAME=pins, "
                    "TYPE=NODE\n4, 1.0\n"),
       kPairVolume,
       {"ALL"},
       {"base", "skin"},
       {"pins"},
       ""},
      {"InpShells",
       ".inp",
       text(kPair + "*ELEMENT, TYPE=S3R, ELSET=lining\n10, 1, 2, 3\n*ELEMENT, TYPE=T3D2, ELSET=bolt\n11, 1, 4\n"),
       kPairVolume,
       {"ALL"},
       {"lining"},
       {"bolt"},
       ""},
      {"InpOthersLeftOut",
       ".inp",
       text(kPair + "*ELEMENT, TYPE=MASS, ELSET=m\n20, 1\n*ELEMENT, TYPE=S4R\n21, 1, 2, 3, 4\n22, 1, 2, 3, 4\n"),
       kPairVolume,
       {"ALL"},
       {},
       {},
       "2 elements of type S4R are left out"},
      {"InpQuadratic", ".inp", text(kQuadratic), 1.0 / 6, {"volume_1"}, {}, {}, kCorners},
      {"InpModifiedQuadratic",
       ".inp",
       text(replaced(kQuadratic, "C3D10", "C3D10MH")),
       1.0 / 6,
       {"volume_1"},
       {},
       {},
       kCorners},
      {"InpAssembly",
       ".inp",
       text(assembly("*Instance, name=Part-1-1, part=Part-1\n*End Instance\n")),
       1.0 / 6,
       {"Set-1"},
       {"Surf-1"},
       {"Set-1", "foot"},
       ""},
      {"InpTwoInstances",
       ".inp",
       text(assembly("*Instance, name=Part-1-1, part=Part-1\n*End Instance\n*Instance, name=Part-1-2, part=Part-1\n "
                     "5., 0., 0.\n 5., 0., 0., 5., 0., 1., 90.\n*End Instance\n")),
       2.0 / 6,
       {"Part-1-1.Set-1", "Part-1-2.Set-1"},
       {"Surf-1"},
       {"Part-1-1.Set-1", "Part-1-2.Set-1", "foot"},
       ""},
      {"InpFortran",
       ".inp",
       text(replaced(kPair, "2, 1., 0, 0", "2, 1.0D+00, 0.D0, +0")),
       kPairVolume,
       {"ALL"},
       {},
       {},
       ""},
      bad("InpNoMesh", "*Heading\n*Step\n", "the mesh has no tetrahedra"),
      bad("InpHexahedron", kNodes + "*ELEMENT, TYPE=C3D8R\n1,1,2,3,4,5,1,2,3\n",
          "*ELEMENT: solids of another shape than tetrahedra"),
      bad("InpNodeMissing", replaced(kPair, "2, 2, 3, 4, 5", "2, 2, 3, 4, 55"),
          "element 2 has a node that the file does not have; given: 55"),
      bad("InpTooFewNodes", replaced(kPair, "2, 2, 3, 4, 5", "2, 2, 3, 4"), "an element of type C3D4 has 4 nodes"),
      bad("InpTooManyNodes", replaced(kPair, "2, 2, 3, 4, 5", "2, 2, 3, 4, 5, 1"),
          "an element of type C3D4 has 4 nodes"),
      bad("InpDecimalComma", replaced(kPair, "2, 1., 0, 0", "2, 1,0, 0,0, 0,0, 0,0"), "a line of a node has"),
      bad("InpWord", replaced(kPair, "2, 1., 0, 0", "2, one, 0, 0"), "InpWord.inp:3: a number is due here"),
      bad("InpLabelTwice", kPair + "*NODE\n5, 0, 0, 0\n", "two nodes have one label; given: 5"),
      bad("InpElementTwice", kPair + "*ELEMENT, TYPE=C3D4\n2, 1, 2, 3, 5\n", "two elements have one label"),
      bad("InpGenerated", kNodes + "*NGEN\n1, 5, 1\n", "*ngen: nodes and elements that a keyword generates"),
      bad("InpSetOfNothing", kPair + "*ELSET, ELSET=a\nnone\n", "a: has a set as a member that the file does not have"),
      bad("InpSetOfNoNode", kPair + "*NSET, NSET=a\n77\n", "a: has a node that the file does not have; given: 77"),
      bad("InpNoInstance", assembly("*Instance, name=Part-1-1, part=Part-2\n*End Instance\n"),
          "there is no *PART of this name"),
      bad("InpNoInclude", kPair + "*INCLUDE, INPUT=more.inp\n", "*INCLUDE: the file cannot be read"),
      bad("InpCylindrical", replaced(kPair, "*NODE", "*NODE, SYSTEM=C"), "nodes in Cartesian coordinates"),
  };
}

TEST(AbaqusFaces, AreThoseOfTheirNumbers) {
  GmshSource source;
  source.file = test::write_file(test::scratch_folder("inp_faces") / "a.inp",
                                 kNodes +
                                     "*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1, 2, 3, 4\n*SURFACE, NAME=f1\n1, S1\n"
                                     "*SURFACE, NAME=f2\nE, S2\n*SURFACE, NAME=f3\n1, s3\n*SURFACE, NAME=f4\n1, S4\n");
  const Mesh mesh = read_gmsh(source).mesh;
  ASSERT_EQ(mesh.surface_groups, (Names{"f1", "f2", "f3", "f4"}));
  ASSERT_EQ(mesh.surface_faces.size(), 4U);
  for (const Mesh::SurfaceFace& face : mesh.surface_faces)
    for (const Index node : face.nodes) {
      const Vec3& x = mesh.nodes[static_cast<std::size_t>(node)];
      EXPECT_EQ((std::array{x.z(), x.y(), 1 - x.sum(), x.x()})[static_cast<std::size_t>(face.group)], 0);
    }
}

class AbaqusFiles : public testing::TestWithParam<Row> {};

TEST_P(AbaqusFiles, AreReadWholeOrRefusedWithALineThatHelps) { test::check_row(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Table, AbaqusFiles, testing::ValuesIn(rows_of_abaqus()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace breccia::inp_table_test
