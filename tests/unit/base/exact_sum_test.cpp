#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "base/exact_sum.hpp"

namespace breccia::exact_sum_test {
namespace {

__extension__ using Wide = __int128;
__extension__ using UnsignedWide = unsigned __int128;

constexpr double kSmallest = std::numeric_limits<double>::denorm_min();
constexpr double kLargest = std::numeric_limits<double>::max();

double sum_of(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double term : terms) sum.add(term);
  return sum.value();
}

TEST(ExactSum, OfNothingIsZero) { EXPECT_EQ(ExactSum().value(), 0.0); }

TEST(ExactSum, OfOneTermIsTheTerm) {
  for (const double term : {1.0, -1.0, 0.1, 1e-300, -3.7e200, kSmallest, -kSmallest, 5 * kSmallest, kLargest, -kLargest,
                            std::numeric_limits<double>::min(), 1.0 + 0x1p-52}) {
    EXPECT_EQ(sum_of({term}), term);
  }
}

TEST(ExactSum, KeepsWhatIsLeftWhenLargeTermsCancel) {
  EXPECT_EQ(sum_of({1.0, 1e100, 1.0, -1e100}), 2.0);
  EXPECT_EQ(sum_of({kLargest, kSmallest, -kLargest}), kSmallest);
  EXPECT_EQ(sum_of({kLargest, kLargest, -kLargest, -kLargest, -kSmallest}), -kSmallest);
  EXPECT_EQ(sum_of({0.1, -0.1}), 0.0);
}

TEST(ExactSum, RoundsToTheNearestAndTiesAwayFromZero) {
  EXPECT_EQ(sum_of({1.0, 0x1p-53}), 1.0 + 0x1p-52);
  EXPECT_EQ(sum_of({-1.0, -0x1p-53}), -1.0 - 0x1p-52);
  EXPECT_EQ(sum_of({1.0, 0x1p-53, -0x1p-1000}), 1.0);
  EXPECT_EQ(sum_of({1.0, 0x1p-53, 0x1p-1000}), 1.0 + 0x1p-52);
}

TEST(ExactSum, AgreesWithIntegersOfAHundredAndTwentyBits) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    Wide exact = 0;
    ExactSum sum;
    for (int i = 0; i < 20; ++i) {
      const auto mantissa = static_cast<std::int64_t>(random()) >> 11;
      const int shift = static_cast<int>(random() % 60);
      exact += static_cast<Wide>(mantissa) * (static_cast<Wide>(1) << shift);
      sum.add(std::ldexp(static_cast<double>(mantissa), shift - 70));
    }
    // Rounded by hand: half away from zero at the 53rd bit.
    UnsignedWide magnitude = exact < 0 ? static_cast<UnsignedWide>(-exact) : static_cast<UnsignedWide>(exact);
    int dropped = 0;
    while ((magnitude >> dropped) >= (static_cast<UnsignedWide>(1) << 53)) ++dropped;
    auto rounded = static_cast<double>(static_cast<std::uint64_t>(magnitude >> dropped));
    if (dropped > 0 && (magnitude >> (dropped - 1) & 1) != 0) rounded += 1;
    EXPECT_EQ(sum.value(), std::copysign(std::ldexp(rounded, dropped - 70), exact < 0 ? -1.0 : 1.0)) << trial;
  }
}

TEST(ExactSum, IsTheSameInAnyOrderAndHoweverSpread) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-300, 300), mantissa(-1, 1);
  std::vector<double> terms;
  for (int i = 0; i < 5000; ++i) terms.push_back(mantissa(random) * std::pow(10, exponent(random)));
  ExactSum first;
  for (const double term : terms) first.add(term);
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(terms.begin(), terms.end(), random);
    std::vector<ExactSum> parts(1 + trial % 7);
    for (const double term : terms) parts[random() % parts.size()].add(term);
    ExactSum merged;
    std::array<std::int64_t, ExactSum::kWords> words{};
    for (const ExactSum& part : parts) {
      merged.add(part);
      const auto of_part = part.words();
      for (std::size_t w = 0; w < words.size(); ++w) words[w] += of_part[w];
    }
    EXPECT_EQ(merged, first);
    EXPECT_EQ(ExactSum::from_words(words), first);
    EXPECT_EQ(merged.value(), first.value());
  }
}

TEST(ExactSum, EqualsAnotherOfTheSameValueWhateverItsTermsWere) {
  ExactSum plain(-1.0), roundabout;
  for (const double term : {1e300, -3.0, kSmallest, -1e300, 2.0, -kSmallest}) roundabout.add(term);
  EXPECT_EQ(roundabout, plain);
  roundabout.add(kSmallest);
  EXPECT_FALSE(roundabout == plain);
  ExactSum broken(-1.0);
  broken.add(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(broken == plain);
}

TEST(ExactSum, OfTenMillionTenthsIsExact) {
  ExactSum sum;
  for (int i = 0; i < 10'000'000; ++i) sum.add(0.1);
  EXPECT_EQ(sum.value(), static_cast<double>(10'000'000.0L * static_cast<long double>(0.1)));
}

TEST(ExactSum, OfATermThatIsNotFiniteIsNotANumber) {
  for (const double term : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    ExactSum sum(1.0);
    sum.add(term);
    EXPECT_TRUE(std::isnan(sum.value()));
    ExactSum other(2.0);
    other.add(sum);
    EXPECT_TRUE(std::isnan(other.value()));
    EXPECT_TRUE(std::isnan(ExactSum::from_words(sum.words()).value()));
    sum.add(ExactSum(3.0));
    EXPECT_TRUE(std::isnan(sum.value())) << "forgotten when a sum that is finite was added";
  }
}

TEST(ExactSum, OfWordsThatNoSumGivesIsNotANumber) {
  for (const std::int64_t word : {std::int64_t{1} << 40, -(std::int64_t{1} << 40),
                                  std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()}) {
    std::array<std::int64_t, ExactSum::kWords> words{};
    words[ExactSum::kLimbs - 1] = word;  // its upper half belongs to a limb that is not there
    EXPECT_TRUE(std::isnan(ExactSum::from_words(words).value())) << word;
  }
  std::array<std::int64_t, ExactSum::kWords> words{};
  words.fill(std::numeric_limits<std::int64_t>::max());
  EXPECT_TRUE(std::isnan(ExactSum::from_words(words).value()));
}

}  // namespace
}  // namespace breccia::exact_sum_test
