#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "experiments.hpp"

namespace breccia::lab {
namespace {

/// Two lists of n / 2 entries each: entry -> next entry of its list, -1 at the end.
struct TwoLists {
  std::vector<std::int32_t> next;
  std::int32_t first, second;
};

TwoLists make_lists(std::int32_t n, bool interleaved) {
  const std::int32_t stride = interleaved ? 2 : 1, half = n / 2;
  TwoLists lists{std::vector<std::int32_t>(static_cast<std::size_t>(n)), 0, interleaved ? 1 : half};
  for (std::int32_t i = 0; i < n; ++i) {
    const bool last = interleaved ? i >= n - 2 : i == half - 1 || i == n - 1;
    lists.next[static_cast<std::size_t>(i)] = last ? -1 : i + stride;
  }
  return lists;
}

/// ns an entry, the best of several walks along both lists in turn.
double walk(const TwoLists& lists, int repeat) {
  const std::size_t n = lists.next.size();
  const std::size_t rounds = std::max<std::size_t>(1, 4'000'000 / n);
  double best = 1e300;
  for (int k = 0; k < repeat; ++k) {
    std::size_t steps = 0;
    const double start = now();
    for (std::size_t round = 0; round < rounds; ++round) {
      for (std::int32_t a = lists.first, b = lists.second; a != -1 && b != -1; steps += 2) {
        a = lists.next[static_cast<std::size_t>(a)];
        b = lists.next[static_cast<std::size_t>(b)];
      }
    }
    best = std::min(best, (now() - start) * 1e9 / static_cast<double>(rounds * n));
    if (steps != rounds * n) throw std::runtime_error("VII: a list is not walked to its end");
  }
  return best;
}

}  // namespace

void run_memory_order(const Options& options) {
  std::ofstream table(options.folder / "memory_order.csv");
  table << "entries,one_behind_the_other_ns,interleaved_ns,difference_percent\n";
  for (std::size_t n = 10'000; n <= std::min<std::size_t>(10 * options.largest, 100'000'000); n *= 10) {
    const auto entries = static_cast<std::int32_t>(n);
    const double a = walk(make_lists(entries, false), options.repeat + 2);
    const double b = walk(make_lists(entries, true), options.repeat + 2);
    std::printf("VII  entries=%-10zu A %.3f ns, B %.3f ns an entry: A takes %+.1f %%\n", n, a, b, 100 * (a / b - 1));
    table << n << ',' << a << ',' << b << ',' << 100 * (a / b - 1) << '\n';
  }
}

}  // namespace breccia::lab
