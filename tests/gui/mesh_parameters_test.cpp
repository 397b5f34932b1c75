#include "core/mesh_parameters.hpp"

#include <gtest/gtest.h>

#include <QJsonDocument>
#include <QTemporaryDir>

#include "core/case_queries.hpp"
#include "gui/block_case.hpp"

namespace breccia::gui::test::mesh_parameters_test {
namespace {

const std::vector<MeshParameter> kKnown{{{"h", "Mesh/h"}, "0.0025", "element size"}, {{"width"}, "1", ""}};

std::vector<ParameterRow> rows_of(const char* text) { return parameter_rows(kKnown, TomlPlaces(text)); }

QStringList names_of(const std::vector<ParameterRow>& rows) {
  QStringList names;
  for (const ParameterRow& row : rows) names << row.name;
  return names;
}

/// A case that is opened, and what an edit makes of it.
struct Edited {
  QTemporaryDir scratch;
  Document document{scratch.filePath("state")};
  explicit Edited(const QByteArray& text) { EXPECT_EQ(document.open(written_case(scratch, text)), ""); }
  QByteArray with(const QString& name, const QString& toml) {
    set_parameter(document, ParameterRow{name, {}, {}}.path(), toml);
    return document.text();
  }
};

TEST(MeshParameters, AreThoseOfTheGeometryAndThoseOfTheCaseThatItDoesNotKnow) {
  EXPECT_EQ(names_of(rows_of("[mesh]\n")), (QStringList{"h", "width"}));
  const auto rows = rows_of("[mesh]\nparameters = { hh = 3, \"Mesh/h\" = \"3 mm\" }\n");
  EXPECT_EQ(names_of(rows), (QStringList{"Mesh/h", "width", "hh"}));
  EXPECT_EQ(rows[0].words, "element size");
  EXPECT_TRUE(rows[0].is_known);
  EXPECT_FALSE(rows[2].is_known);
  EXPECT_EQ(names_of(rows_of("[mesh.parameters]\nh = 3\nx = 2\n")), (QStringList{"h", "width", "x"}));
  EXPECT_TRUE(rows_of("[mesh]\nparameters = 3\n").empty());
  EXPECT_TRUE(parameter_rows({}, TomlPlaces("[mesh]\nparameters = { x = 3 }\n"))[0].is_known);  // nobody said it is not
}

TEST(MeshParameters, AreSetWhereTheyStandAndAllElseStays) {
  EXPECT_EQ(Edited("[mesh]\nparameters = { a = 1, h = \"3 mm\" }   # mine\n").with("h", "2"),
            "[mesh]\nparameters = { a = 1, h = 2 }   # mine\n");
  EXPECT_EQ(Edited("[mesh]\nparameters = { a = 1, h = 2 }   # mine\n").with("h", ""),
            "[mesh]\nparameters = { a = 1 }   # mine\n");
  EXPECT_EQ(Edited("[mesh]\nparameters = { a = 1 }\n").with("Mesh/h", "2"),
            "[mesh]\nparameters = { a = 1, \"Mesh/h\" = 2 }\n");
  EXPECT_EQ(Edited("[mesh]\nfile = \"a.geo\"  # mine\n\n[time]\n").with("h", "2"),
            "[mesh]\nfile = \"a.geo\"  # mine\nparameters = { h = 2 }\n\n[time]\n");
  EXPECT_EQ(Edited("[mesh.parameters]\nh = 1  # mine\n").with("w", "2"), "[mesh.parameters]\nh = 1  # mine\nw = 2\n");
  EXPECT_EQ(Edited("[mesh]\nparameters.h = 1  # mine\nscale = 1\n").with("w", "2"),
            "[mesh]\nparameters.h = 1  # mine\nparameters.w = 2\nscale = 1\n");
  EXPECT_EQ(Edited("mesh.parameters.h = 1\n").with("w", "2"), "mesh.parameters.h = 1\nmesh.parameters.w = 2\n");
}

TEST(MeshParameters, EachEditIsOneStepBack) {
  const QByteArray text = "[mesh]\nparameters = { h = 1 }  # mine\n";
  Edited edited(text);
  edited.with("w", "\"3 mm\"");
  edited.with("h", "");
  edited.document.undo_stack().undo();
  edited.document.undo_stack().undo();
  EXPECT_EQ(edited.document.text(), text);
  EXPECT_FALSE(edited.document.undo_stack().canUndo());
}

TEST(MeshParameters, AreToldByTheSolverAlsoWhileTheCaseHasMistakes) {
  QTemporaryDir scratch;
  QFile geometry(scratch.filePath("bar.geo"));
  ASSERT_TRUE(geometry.open(QIODevice::WriteOnly));
  geometry.write("DefineConstant[ h = 2e-3, // element size\n n = {3, Name \"Mesh/n\"} ];\n");
  geometry.close();
  Document document(scratch.filePath("state"));
  EXPECT_EQ(document.open(written_case(scratch, "[mesh]\nfile = \"bar.geo\"\n[[material]]\n")), "");
  EXPECT_EQ(script_of(document), scratch.filePath("bar.geo"));
  CaseQueries queries(document, BRECCIA_PROGRAM);
  std::optional<std::vector<MeshParameter>> told;
  QObject::connect(&queries, &CaseQueries::parameters_told,
                   [&](const QJsonObject& json) { told = mesh_parameters(json); });
  queries.parameters();
  ASSERT_TRUE(wait_until([&] { return told.has_value(); }, 20000));
  EXPECT_EQ(*told, (std::vector<MeshParameter>{{{"h"}, "2e-3", "element size"}, {{"n", "Mesh/n"}, "3", ""}}));
  document.set_value("mesh.file", "\"bar.msh\"");
  EXPECT_EQ(script_of(document), "");
}

}  // namespace
}  // namespace breccia::gui::test::mesh_parameters_test
