#include "base/exact_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace breccia {
namespace {

/// Value of the lowest bit of the first limb.
constexpr int kLowest = -1088;

}  // namespace

void ExactSum::carry() {
  std::int64_t over = 0;
  for (std::size_t k = 0; k < kLimbs; ++k) {
    const std::int64_t limb = limbs_[k] + over;
    over = limb >> 32;
    limbs_[k] = limb & 0xFFFFFFFF;
  }
  limbs_.back() += over * (std::int64_t{1} << 32);  // the last limb keeps the sign
  pending_ = 0;
}

void ExactSum::add(const ExactSum& other) {
  finite_ = finite_ && other.finite_;
  if (pending_ + 1 >= kMostPending) carry();
  ExactSum carried = other;
  carried.carry();
  for (std::size_t k = 0; k < kLimbs; ++k) limbs_[k] += carried.limbs_[k];
  ++pending_;
}

double ExactSum::value() const {
  if (!finite_) return std::numeric_limits<double>::quiet_NaN();
  ExactSum magnitude = *this;
  magnitude.carry();
  const bool negative = magnitude.limbs_.back() < 0;
  if (negative) {
    for (std::int64_t& limb : magnitude.limbs_) limb = -limb;
    magnitude.carry();
  }
  const auto& limbs = magnitude.limbs_;
  std::size_t top = kLimbs;
  while (top > 0 && limbs[top - 1] == 0) --top;
  if (top == 0) return 0.0;
  // The 64 bits from the leading one on; what lies below them does not matter to rounding half away from zero.
  const auto limb = [&](std::size_t below) {
    return top > below ? static_cast<std::uint64_t>(limbs[top - 1 - below]) : std::uint64_t{0};
  };
  const int lead = std::countl_zero(limb(0)) - 32;
  const std::uint64_t bits = limb(0) << (32 + lead) | limb(1) << lead | (lead > 0 ? limb(2) >> (32 - lead) : 0);
  const int exponent = kLowest + static_cast<int>(top - 1) * 32 - 32 - lead;  // of the lowest of the 64 bits
  const int kept = std::min(53, 64 + exponent + 1074);                       // fewer for subnormal results
  if (kept < 0) return negative ? -0.0 : 0.0;
  const int dropped = 64 - kept;
  const std::uint64_t half = 1ULL << (dropped - 1);
  const std::uint64_t tail = kept == 0 ? bits : bits & ((1ULL << dropped) - 1);
  std::uint64_t mantissa = kept == 0 ? 0 : bits >> dropped;
  if (tail >= half) ++mantissa;
  const double value = std::ldexp(static_cast<double>(mantissa), exponent + dropped);
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
  ExactSum sum;
  std::copy(words.begin(), words.end() - 1, sum.limbs_.begin());
  sum.finite_ = words.back() == 0;
  sum.carry();
  return sum;
}

}  // namespace breccia
