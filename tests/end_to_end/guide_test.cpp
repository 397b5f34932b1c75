#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "end_to_end/program.hpp"

namespace breccia::test::guide_test {
namespace {

namespace fs = std::filesystem;

/// The program in a folder with a blank, with a guide of empty pages beside it as it is installed.
struct Installed {
  Scratch scratch;
  fs::path root = scratch.path("an installation");

  Installed() {
    fs::create_directories(root / "bin");
    fs::copy_file(BRECCIA_PROGRAM, root / "bin/breccia");
    for (const char* page : {"index", "search", "guide/04-contact-and-friction", "guide/07-ranks-and-clusters",
                             "theory/friction", "theory/energy", "cases/disc", "reference/material"})
      write(root / "share/doc/breccia/guide" / (std::string(page) + ".html"));
  }
  static void write(const fs::path& page) {
    fs::create_directories(page.parent_path());
    std::ofstream(page) << "<html>";
  }
  [[nodiscard]] Outcome run(const std::string& arguments) const {
    return outcome_of("env -u DISPLAY -u WAYLAND_DISPLAY '" + (root / "bin/breccia").string() + "' guide " + arguments);
  }
};

TEST(Guide, ATopicLeadsToItsPage) {
  const Installed installed;
  for (const auto& [topic, page] :
       {std::pair{"", "index.html"}, std::pair{"contact", "guide/04-contact-and-friction.html"},
        std::pair{"domains", "guide/07-ranks-and-clusters.html"},
        std::pair{"clusters", "guide/07-ranks-and-clusters.html"},
        std::pair{"Friction", "guide/04-contact-and-friction.html"}, std::pair{"energy", "theory/energy.html"},
        std::pair{"disc", "cases/disc.html"}, std::pair{"material.young", "reference/material.html#material-young"},
        std::pair{"'time integration'", "search.html?q=time%20integration"}}) {
    const Outcome outcome = installed.run(topic);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(outcome.out.starts_with("file:///")) << outcome.out;
    EXPECT_TRUE(outcome.out.ends_with("/an%20installation/share/doc/breccia/guide/" + std::string(page) + "\n"))
        << topic << ": " << outcome.out;
  }
}

TEST(Guide, ThatIsNotInstalledIsNamedWithTheWayToIt) {
  const Installed installed;
  fs::remove_all(installed.root / "share");
  const Outcome outcome = installed.run("contact");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("./run guide"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace breccia::test::guide_test
