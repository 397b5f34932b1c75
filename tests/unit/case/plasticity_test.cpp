#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "case_files.hpp"

namespace breccia::case_::plasticity_test {
namespace {

/// A change that makes the complete case wrong, and what the one message must say.
struct Wrong {
  const char* from;
  const char* to;
  std::vector<const char*> says;
};

TEST(Plasticity, ThatCannotBeIsRefusedWithOneMessageThatSaysWhy) {
  for (const Wrong& wrong : {
           Wrong{"friction_angle = \"36 deg\"",
                 "friction_angle = \"96 deg\"",
                 {"material[2].friction_angle: is out of range"}},
           Wrong{"viscosity = \"3 Pa s\"",
                 "cohesion = 1e6",
                 {"material[0].cohesion: belongs to a law", "law = \"drucker_prager\""}},
           Wrong{"viscosity = \"3 Pa s\"", "cap_pressure = 1e6", {"material[0].cap_pressure: belongs to a law"}},
           Wrong{"friction_angle = \"36 deg\"\ndilation_angle = \"9 deg\"\ncohesion = \"8 MPa\"",
                 "",
                 {"material[2].cohesion: the material has no strength", "friction_angle > 0"}},
           Wrong{"\"9 deg\"",
                 "\"40 deg\"",
                 {"material[2].dilation_angle: is above the friction angle", "at most friction_angle"}},
           Wrong{"\"2 MPa\"", "\"12 MPa\"", {"material[2].tension_cutoff: lies beyond the tip", "11011055"}},
           Wrong{"cap_pressure = \"150 MPa\"",
                 "cap_pressure = \"none\"",
                 {"material[2].cap_hardening: hardens a cap that is not there", "cap_pressure"}},
           Wrong{"\"200 MPa\"", "\"-200 MPa\"", {"material[2].hardening: is out of range", ">= 0"}},
       }) {
    const std::string message = message_of(replaced(complete, wrong.from, wrong.to));
    for (const char* part : wrong.says) EXPECT_THAT(message, testing::HasSubstr(part));
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
  }
}

TEST(Plasticity, OfCohesionAloneMayHaveAnyCutoff) {
  const std::string ductile = "law = \"drucker_prager\"\ncohesion = 1e6\ntension_cutoff = 9e6\njoints =";
  EXPECT_EQ(message_of(replaced(minimal, "joints =", ductile)), "");
}

}  // namespace
}  // namespace breccia::case_::plasticity_test
