#include "model/strength_scatter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "model/model.hpp"
#include "unit/model/two_boxes.hpp"

namespace breccia::strength_scatter_test {
namespace {

using test::two_boxes_case;

constexpr GlobalId kMany = 100000;

case_::Joint scattered(double modulus, double area = 0, std::uint64_t seed = 1) {
  case_::Joint joint;
  joint.weibull_modulus = modulus;
  joint.weibull_area = area;
  joint.weibull_seed = seed;
  return joint;
}

double factor(const case_::Joint& joint, GlobalId id, double area = 1) {
  return strength_factor(strength_class(joint, id, area));
}

struct Moments {
  double mean = 0, deviation = 0;
};

template <class Sample>
Moments moments_of(GlobalId samples, Sample&& sample) {
  double sum = 0, squares = 0;
  for (GlobalId i = 0; i < samples; ++i) {
    const double x = sample(i);
    sum += x;
    squares += x * x;
  }
  const auto n = static_cast<double>(samples);
  return {sum / n, std::sqrt(squares / n - sum * sum / (n * n))};
}

TEST(StrengthScatter, HasTheMeanAndTheDeviationOfItsModulus) {
  for (const double m : {1.0, 3.0, 10.0, 30.0}) {
    const case_::Joint joint = scattered(m);
    const Moments found = moments_of(kMany, [&](GlobalId id) { return factor(joint, id); });
    const double mean = std::tgamma(1 + 1 / m);
    const double deviation = std::sqrt(std::tgamma(1 + 2 / m) / (mean * mean) - 1);
    EXPECT_NEAR(found.mean, 1, 0.01 * deviation) << m;  // three times the error of so many samples
    EXPECT_NEAR(found.deviation / deviation, 1, 0.02) << m;
  }
}

TEST(StrengthScatter, FollowsWeibullInItsTails) {
  const double m = 10, scale = 1 / std::tgamma(1 + 1 / m);
  const case_::Joint joint = scattered(m);
  for (const double share : {0.01, 0.1, 0.9, 0.99}) {
    const double bound = scale * std::pow(-std::log(1 - share), 1 / m);
    double below = 0;
    for (GlobalId id = 0; id < kMany; ++id) below += factor(joint, id) < bound ? 1.0 / kMany : 0;
    // A class is two per cent wide, over which this share of the strengths lies.
    const double width = 0.01 * m * -(1 - share) * std::log(1 - share);
    EXPECT_NEAR(below, share, width + 4 * std::sqrt(share * (1 - share) / kMany)) << share;
  }
}

TEST(StrengthScatter, IsAnotherSampleForAnotherSeed) {
  const case_::Joint first = scattered(5), second = scattered(5, 0, 2);
  const auto both = [&](auto&& f) { return moments_of(kMany, f).mean; };
  const double product = both([&](GlobalId id) { return (factor(first, id) - 1) * (factor(second, id) - 1); });
  EXPECT_NEAR(product, 0, 0.01 * 0.229 * 0.229) << "strengths of two seeds have nothing in common";
  const double next = both([&](GlobalId id) { return (factor(first, id) - 1) * (factor(first, id + 1) - 1); });
  EXPECT_NEAR(next, 0, 0.01 * 0.229 * 0.229) << "nor those of joints beside each other";
  EXPECT_EQ(strength_class(first, 77, 1), strength_class(scattered(5), 77, 1));
}

TEST(StrengthScatter, WithAReferenceAreaBreaksFineMeshesAtTheSameLoadAsCoarseOnes) {
  const case_::Joint joint = scattered(4, 1.0);
  constexpr GlobalId kSamples = 10000;
  for (const GlobalId parts : {1, 4, 16}) {
    const Moments weakest = moments_of(kSamples, [&](GlobalId sample) {
      double least = 1e30;
      for (GlobalId i = 0; i < parts; ++i)
        least = std::min(least, factor(joint, sample * parts + i, 1.0 / static_cast<double>(parts)));
      return least;
    });
    EXPECT_NEAR(weakest.mean, 1, 0.012) << parts;
  }
}

TEST(ModelWithScatter, HasTheLawOfItsClassForEveryJoint) {
  const case_::Case input = two_boxes_case({}, test::kTwoBoxesCase);
  case_::Case scatters = input;
  scatters.joints[0].weibull_modulus = 6;  // "left"
  scatters.joints[2].weibull_modulus = 3;  // the interface
  const Model model = build_model(scatters), even = build_model(input);
  ASSERT_EQ(model.joint_law_names, even.joint_law_names);
  EXPECT_EQ(model.joint_sizes, even.joint_sizes);
  EXPECT_EQ(static_cast<std::int64_t>(model.joint_laws.size()), model.whole.num_joint_laws());
  ASSERT_EQ(model.joint_laws.size(), model.groups_of_joint_law.size());
  ASSERT_EQ(model.joints.size(), even.joints.size());
  std::size_t others = 0;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const auto law = static_cast<std::size_t>(model.joints[j].law),
               reference = static_cast<std::size_t>(even.joints[j].law);
    ASSERT_EQ(model.groups_of_joint_law[law], even.joints[j].law);
    const JointLawParams &one = model.joint_laws[law], &mean = even.joint_laws[reference];
    const std::string& name = even.joint_law_names[reference];
    double expected = 1;
    if (name != "right") {
      const case_::Joint& entry = scatters.joints[name == "left" ? 0 : 2];
      expected = strength_factor(strength_class(entry, model.joint_id(j), model.joints[j].face.area));
    }
    EXPECT_DOUBLE_EQ(one.tensile_strength, expected * mean.tensile_strength);
    EXPECT_DOUBLE_EQ(one.cohesion, expected * mean.cohesion);
    EXPECT_EQ(one.energy_mode_1, mean.energy_mode_1);
    EXPECT_EQ(one.stiffness, mean.stiffness);
    others += one.tensile_strength != mean.tensile_strength ? 1 : 0;
  }
  EXPECT_GT(others, model.joints.size() / 4);
}

TEST(ModelWithScatter, RefusesAPenaltyTooSoftForItsStrongestJoint) {
  case_::Case input = two_boxes_case({"joint[0].penalty_factor=30"});
  EXPECT_NO_THROW((void)build_model(input));
  input.joints[0].weibull_modulus = 1;
  try {
    (void)build_model(input);
    FAIL() << "a joint whose elastic part alone holds more than its energy";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("times the mean strength (weibull_modulus): penalty too soft"));
  }
}

}  // namespace
}  // namespace breccia::strength_scatter_test
