#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace breccia::lab {

/// Random numbers between 0 and 1, both excluded: two multiplicative congruential generators whose difference is taken
/// (L'Ecuyer 1988: moduli 2147483563 and 2147483399, multipliers 40014 and 40692), the first through a table of 32
/// values that the output itself picks from (Bays and Durham). Period about 2e18. The thesis's experiments give it a
/// seed by reference: a negative one starts it anew, and it holds the first generator's state from then on; seeds used
/// in turn share the table and the second generator, as in the experiments.
class Generator {
 public:
  double operator()(std::int64_t& seed) {
    if (seed <= 0) start(seed);
    seed = seed * 40014 % first_modulus;
    second_ = second_ * 40692 % second_modulus;
    std::int64_t& entry = table_[static_cast<std::size_t>(last_ / (1 + (first_modulus - 1) / 32))];
    last_ = entry - second_;
    entry = seed;
    if (last_ < 1) last_ += first_modulus - 1;
    return static_cast<double>(last_) / static_cast<double>(first_modulus);
  }

 private:
  static constexpr std::int64_t first_modulus = 2147483563, second_modulus = 2147483399;
  static constexpr int num_warm_up = 8;

  void start(std::int64_t& seed) {
    seed = seed == 0 ? 1 : -seed;
    second_ = seed;
    for (int i = 0; i < num_warm_up; ++i) seed = seed * 40014 % first_modulus;
    for (auto entry = table_.rbegin(); entry != table_.rend(); ++entry) {
      seed = seed * 40014 % first_modulus;
      *entry = seed;
    }
    last_ = table_[0];
  }

  std::int64_t second_ = 1, last_ = 1;
  std::array<std::int64_t, 32> table_{};
};

}  // namespace breccia::lab
