#include "core/toml_places.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "case/reader_toml.hpp"

namespace breccia::gui::toml_places_test {
namespace {

const std::string kText = R"(title = "a # b"  # comment
[mesh]
parameters = { h = "1 mm", n = 3 }
[mesh.raster]
cells = [1,
         2, # two
         3]
[[material]]
group = "one"
young = "1 GPa" # stiff
[[material]]
group = 'two'
young = 2e9
[material.extra]
deep.er = true
[[stage]]
end = 1
constraint = [{ group = "one", fixed = "xyz" }, { group = "two" }]
[[stage]]
end = 2
[[stage.constraint]]
group = "one"
[stage.constraint.velocity]
x = "1 m/s"
)";

TEST(TomlPlaces, ValuesStandWhereThePathSays) {
  const TomlPlaces places(kText);
  EXPECT_EQ(places.value("title"), "\"a # b\"");
  EXPECT_EQ(places.value("mesh.parameters.n"), "3");
  EXPECT_EQ(places.value("mesh.raster.cells[2]"), "3");
  EXPECT_EQ(places.value("material[0].young"), "\"1 GPa\"");
  EXPECT_EQ(places.value("material[1].young"), "2e9");
  EXPECT_EQ(places.value("material[1].extra.deep.er"), "true");
  EXPECT_EQ(places.value("stage[0].constraint[1].group"), "\"two\"");
  EXPECT_EQ(places.value("stage[1].constraint[0].velocity.x"), "\"1 m/s\"");
  EXPECT_EQ(places.count("material"), 2);
  EXPECT_EQ(places.count("stage[0].constraint"), 2);
  EXPECT_EQ(places.count("stage[1].constraint"), 1);
  EXPECT_EQ(places.find("material[1].young")->line, 13);
  EXPECT_EQ(places.path_at_line(13), "material[1].young");
}

std::string after(const TomlPlaces& places, const TextChange& change) { return applied(places.text(), change); }

TEST(TomlPlaces, AValueIsReplacedAndNothingElse) {
  const TomlPlaces places(kText);
  std::string expected = kText;
  expected.replace(expected.find("\"1 GPa\""), 7, "\"70 GPa\"");
  EXPECT_EQ(after(places, places.set("material[0].young", "\"70 GPa\"")), expected);
}

TEST(TomlPlaces, ANewValueStandsInItsSection) {
  const TomlPlaces places(kText);
  for (const auto& [path, value] :
       std::vector<std::pair<std::string, std::string>>{{"material[0].poisson", "0.2"},
                                                        {"material[1].poisson", "0.3"},
                                                        {"material[1].extra.more", "1"},
                                                        {"mesh.file", "\"a.geo\""},
                                                        {"mesh.parameters.k", "4"},
                                                        {"mesh.raster.slit.lower", "[0, 0, 0]"},
                                                        {"stage[0].constraint[1].fixed", "\"x\""},
                                                        {"stage[1].constraint[0].fixed", "\"x\""},
                                                        {"stage[0].name", "\"first\""},
                                                        {"output.frame_interval", "1"},
                                                        {"other", "5"}}) {
    const TomlPlaces now(after(places, places.set(path, value)));
    EXPECT_EQ(now.value(path), value) << path << "\n" << now.text();
    EXPECT_NO_THROW((void)case_::parse_toml_text(now.text(), "t")) << now.text();
    EXPECT_EQ(now.count("material"), 2) << path;
  }
}

TEST(TomlPlaces, WhatIsRemovedTakesItsLineOrItsSectionsWithIt) {
  const TomlPlaces places(kText);
  for (const std::string path : {"material[0].young", "mesh.parameters.h", "mesh.parameters.n", "mesh.raster",
                                 "stage[0].constraint[1].group", "title"}) {
    const TomlPlaces now(after(places, places.remove(path)));
    EXPECT_EQ(now.find(path), nullptr) << path << "\n" << now.text();
    EXPECT_NO_THROW((void)case_::parse_toml_text(now.text(), "t")) << now.text();
  }
  const TomlPlaces shorter(after(places, places.remove("stage[1]")));
  EXPECT_EQ(shorter.count("stage"), 1);
  EXPECT_EQ(shorter.value("stage[0].end"), "1");
  const TomlPlaces one(after(places, places.remove("material[0]")));
  EXPECT_EQ(one.value("material[0].group"), "'two'");
}

TEST(TomlPlaces, ANewEntryFollowsTheLastOfItsList) {
  const TomlPlaces places(kText);
  const TomlPlaces now(after(places, places.add_entry("material", "group = \"three\"\n")));
  EXPECT_EQ(now.count("material"), 3);
  EXPECT_EQ(now.value("material[2].group"), "\"three\"");
  EXPECT_EQ(now.value("material[1].extra.deep.er"), "true");
  const TomlPlaces inside(after(places, places.add_entry("stage[0].constraint", "group = \"x\"\nfixed = \"y\"\n")));
  EXPECT_EQ(inside.value("stage[0].constraint[2].fixed"), "\"y\"");
  const TomlPlaces first(after(places, places.add_entry("contact", "penalty = 1\n")));
  EXPECT_EQ(first.value("contact[0].penalty"), "1");
  for (const TomlPlaces* made : {&now, &inside, &first})
    EXPECT_NO_THROW((void)case_::parse_toml_text(made->text(), "t")) << made->text();
}

TEST(TomlPlaces, LineEndsOfWindowsStay) {
  const TomlPlaces places("a = 1\r\n[b]\r\nc = 2\r\n");
  EXPECT_EQ(places.value("b.c"), "2");
  EXPECT_EQ(after(places, places.set("b.d", "3")), "a = 1\r\n[b]\r\nc = 2\r\nd = 3\r\n");
}

TEST(TomlPlaces, BrokenTextIsPassedOver) {
  for (const std::string text :
       {"a = ", "[", "[[a", "= 3", "a = [1, 2", "a = { b = ", "a = \"x", "'''", "\xff\xfe = \xff", "a = \"\"\"x"}) {
    const TomlPlaces places(text + "\nz = 1\n");
    EXPECT_EQ(places.text(), text + "\nz = 1\n");
  }
}

void compare(const case_::Node& node, const std::string& path, const TomlPlaces& places) {
  if (node.is(case_::Node::Kind::table)) {
    for (const auto& [name, value] : node.entries) compare(value, path.empty() ? name : path + "." + name, places);
  } else if (node.is(case_::Node::Kind::list) && !node.items.empty() && node.items[0].is(case_::Node::Kind::table)) {
    EXPECT_EQ(places.count(path), static_cast<int>(node.items.size())) << path;
    for (std::size_t i = 0; i < node.items.size(); ++i)
      compare(node.items[i], path + "[" + std::to_string(i) + "]", places);
  } else {
    ASSERT_NE(places.find(path), nullptr) << path;
    EXPECT_EQ(case_::parse_toml_value(places.value(path), "t").shown(), node.shown()) << path;
  }
}

TEST(TomlPlaces, FindsEveryValueOfEveryShippedCase) {
  int cases = 0;
  for (const auto& file : std::filesystem::recursive_directory_iterator(BRECCIA_MESHES)) {
    if (file.path().extension() != ".toml") continue;
    std::ifstream in(file.path(), std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    compare(case_::parse_toml_file(file.path()), "", TomlPlaces(text.str()));
    ++cases;
  }
  EXPECT_GT(cases, 20);
}

}  // namespace
}  // namespace breccia::gui::toml_places_test
