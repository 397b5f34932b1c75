#include "base/exact_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace breccia {
namespace {

/// Value of the lowest bit of the first limb.
constexpr int kLowest = -1088;
/// What a limb of 2^30 sums stays below.
constexpr std::int64_t kLargestWord = std::int64_t{1} << 62;

}  // namespace

void ExactSum::carry() {
  pending_ = 0;
  if (first_ > last_) return;
  const auto keeps_sign = [](std::int64_t limb) { return limb == static_cast<std::int32_t>(limb); };
  for (std::size_t k = first_; k < last_ || !keeps_sign(limbs_[k]); ++k) {
    if (k + 1 == kLimbs) {  // more than doubles can add up to: words that no sum has given
      *this = ExactSum(std::numeric_limits<double>::quiet_NaN());
      return;
    }
    limbs_[k + 1] += limbs_[k] >> 32;
    limbs_[k] &= 0xFFFFFFFF;
    last_ = std::max(last_, k + 1);
  }
}

void ExactSum::add(const ExactSum& other) {
  finite_ = finite_ && other.finite_;
  if (pending_ + 1 >= kMostPending) carry();
  ExactSum carried = other;
  carried.carry();
  for (std::size_t k = carried.first_; k <= carried.last_; ++k) limbs_[k] += carried.limbs_[k];
  first_ = std::min(first_, carried.first_);
  last_ = std::max(last_, carried.last_);
  ++pending_;
}

double ExactSum::value() const {
  if (!finite_) return std::numeric_limits<double>::quiet_NaN();
  ExactSum magnitude = *this;
  magnitude.carry();
  const bool negative = magnitude.limbs_[magnitude.last_] < 0;
  if (negative) {
    for (std::size_t k = magnitude.first_; k <= magnitude.last_; ++k) magnitude.limbs_[k] *= -1;
    magnitude.carry();
  }
  const auto& limbs = magnitude.limbs_;
  std::size_t top = magnitude.last_ + 1;
  while (top > 0 && limbs[top - 1] == 0) --top;
  if (top == 0) return 0.0;
  // The 64 bits from the leading one on; what lies below them does not matter to rounding half away from zero.
  const auto limb = [&](std::size_t below) {
    return top > below ? static_cast<std::uint64_t>(limbs[top - 1 - below]) : std::uint64_t{0};
  };
  const int lead = std::countl_zero(limb(0)) - 32;
  const std::uint64_t bits = limb(0) << (32 + lead) | limb(1) << lead | (lead > 0 ? limb(2) >> (32 - lead) : 0);
  const int exponent = kLowest + static_cast<int>(top - 1) * 32 - 32 - lead;  // of the lowest of the 64 bits
  constexpr int kDropped = 64 - 53;
  const std::uint64_t half = bits >> (kDropped - 1) & 1;
  const std::uint64_t mantissa = (bits >> kDropped) + half;
  // A sum of doubles is a multiple of the smallest one: subnormal results are exact, ldexp has nothing to round.
  const double value = std::ldexp(static_cast<double>(mantissa), exponent + kDropped);
  return negative ? -value : value;
}

std::array<std::int64_t, ExactSum::kWords> ExactSum::words() const {
  ExactSum carried = *this;
  carried.carry();
  std::array<std::int64_t, kWords> words{};
  std::copy(carried.limbs_.begin(), carried.limbs_.end(), words.begin());
  words.back() = finite_ ? 0 : 1;
  return words;
}

ExactSum ExactSum::from_words(std::span<const std::int64_t, kWords> words) {
  const auto possible = [](std::int64_t word) { return -kLargestWord < word && word < kLargestWord; };
  if (!std::all_of(words.begin(), words.end(), possible)) return ExactSum(std::numeric_limits<double>::quiet_NaN());
  ExactSum sum;
  std::copy(words.begin(), words.end() - 1, sum.limbs_.begin());
  sum.finite_ = words.back() == 0;
  for (std::size_t k = 0; k < kLimbs; ++k) {
    if (sum.limbs_[k] == 0) continue;
    sum.first_ = std::min(sum.first_, k);
    sum.last_ = k;
  }
  sum.carry();
  return sum;
}

bool operator==(const ExactSum& a, const ExactSum& b) {
  auto difference = a.words();
  const auto of_b = b.words();
  for (std::size_t w = 0; w < difference.size(); ++w) difference[w] -= of_b[w];
  const auto carried = ExactSum::from_words(difference).words();
  return std::all_of(carried.begin(), carried.end(), [](std::int64_t word) { return word == 0; });
}

}  // namespace breccia
