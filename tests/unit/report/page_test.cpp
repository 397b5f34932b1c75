#include "report/page.hpp"

#include <gtest/gtest.h>

#include <string>

namespace breccia::report::page_test {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

RunRecord record_in(const std::string& folder, const std::string& state) {
  RunRecord run;
  run.folder = folder;
  run.state = state;
  return run;
}

TEST(Pages, ShowNothingOfARunAsMarkup) {
  RunRecord run;
  const std::string evil = "\"><script>alert(1)</script>";
  run.folder = "/runs/" + evil;
  run.title = run.state = run.message = run.case_text = evil;
  run.provenance.command_line = {"breccia", evil};
  run.provenance.inputs = {{evil, evil}};
  run.provenance.version = run.provenance.host = run.provenance.flags = evil;
  run.flaws = {evil};
  run.events.resize(1);
  run.events[0].kind = "resume";
  run.events[0].text = evil;
  run.events[0].accepted = false;
  run.phases = {{evil, 1.0}};
  run.words["state_hash"] = run.words["simd"] = evil;
  run.history.names = {"time [s]",
                       "contacts",
                       evil + " velocity x [m/s]",
                       evil + " velocity y [m/s]",
                       evil + " velocity z [m/s]",
                       evil + " contact force x [N]"};
  run.history.columns.assign(6, {1.0, 2.0});
  Figures figures;
  figures.paraview = figures.missing = evil;
  figures.problems = {evil};
  figures.pictures = {{"Zg==", evil, evil, 0}};
  const std::string page = page_of(run, figures, evil);
  EXPECT_FALSE(has(page, "<script")) << page.substr(page.find("<script"), 200);
  EXPECT_FALSE(has(page, "\"&gt;<"));
  EXPECT_TRUE(has(page, "&lt;script&gt;"));
}

TEST(Pages, OfARunWithoutFilesAreWhole) {
  const RunRecord run = record_in("/runs/empty", "unknown");
  const std::string page = page_of(run, {}, "");
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(page.ends_with("</html>\n"));
  EXPECT_TRUE(has(page, "<h1>empty</h1>"));
  EXPECT_FALSE(has(page, "nan"));
}

TEST(Pages, NameTheGaugeOfAChartOfOneCurve) {
  RunRecord run;
  run.bodies = {"plate"};
  run.history.names = {"time [s]", "body 0 contact force x [N]", "body 0 contact force y [N]",
                       "body 0 contact force z [N]"};
  run.history.columns.assign(4, {1.0, 2.0});
  EXPECT_TRUE(has(gauges(run), "The gauge is plate (body 0).")) << gauges(run);
}

TEST(Pages, ShowMaterialsJointsAndContactsOnceForGroupsThatHaveThemInCommon) {
  RunRecord run;
  for (const char* group : {"plate", "anvil", "<wheel>"}) {
    case_::Material& material = run.materials.emplace_back();
    material.group = group;
    material.density = 2456;
    material.young = group == std::string("anvil") ? 2.1e11 : 7e10;
  }
  case_::Joint& joint = run.joints.emplace_back();
  joint.groups = {"plate", "anvil"};
  joint.energy_mode_1 = 12.5;
  run.contacts.emplace_back().groups = {"*", "*"};
  const std::string html = model(run);
  EXPECT_TRUE(
      has(html, "<th scope=\"col\" class=\"n\">plate, &lt;wheel&gt;</th><th scope=\"col\" class=\"n\">anvil</th>"))
      << html;
  EXPECT_TRUE(has(html, ">70 GPa</data></td><td class=\"n\"><data value=\"210000000000\">210 GPa<")) << html;
  EXPECT_TRUE(has(html, ">2456 kg/m3<")) << html;
  EXPECT_TRUE(has(html, "plate – anvil")) << html;
  EXPECT_TRUE(has(html, ">softening.kind<")) << html;
  EXPECT_TRUE(has(html, "12.5 J/m")) << html;
  EXPECT_TRUE(has(html, "any – any")) << html;
  EXPECT_EQ(model({}), "");
}

TEST(Pages, WarnOfABudgetThatDoesNotClose) {
  RunRecord run = record_in("/runs/a", "complete");
  run.numbers["energy_residual_relative"] = 1e-3;
  EXPECT_EQ(warnings(run, {}), "");
  run.numbers["energy_residual_relative"] = -0.02;
  EXPECT_TRUE(has(warnings(run, {}), "does not close"));
}

}  // namespace
}  // namespace breccia::report::page_test
