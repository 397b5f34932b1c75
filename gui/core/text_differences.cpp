#include "core/text_differences.hpp"

#include <algorithm>
#include <vector>

namespace breccia::gui {
namespace {

constexpr int kMostLines = 3000;  // whose pairs are compared

/// Length of the longest common subsequence of the lines from (i, j) on, for all pairs; rows of width m + 1.
std::vector<int> common_lengths(const QStringList& a, const QStringList& b) {
  const auto n = static_cast<std::size_t>(a.size()), m = static_cast<std::size_t>(b.size());
  std::vector<int> length((n + 1) * (m + 1), 0);
  for (std::size_t i = n; i-- > 0;)
    for (std::size_t j = m; j-- > 0;) {
      const std::size_t at = i * (m + 1) + j;
      length[at] = a[static_cast<int>(i)] == b[static_cast<int>(j)] ? length[at + m + 2] + 1
                                                                    : std::max(length[at + m + 1], length[at + 1]);
    }
  return length;
}

/// Takes away what both begin with.
void drop_common_front(QStringList& a, QStringList& b) {
  int same = 0;
  while (same < a.size() && same < b.size() && a[same] == b[same]) ++same;
  a = a.mid(same);
  b = b.mid(same);
}

void drop_common_end(QStringList& a, QStringList& b) {
  while (!a.isEmpty() && !b.isEmpty() && a.back() == b.back()) {
    a.removeLast();
    b.removeLast();
  }
}

}  // namespace

QStringList line_differences(const QString& before, const QString& after) {
  QStringList a = before.split('\n'), b = after.split('\n'), found;
  drop_common_front(a, b);
  drop_common_end(a, b);
  const bool compared = a.size() <= kMostLines && b.size() <= kMostLines;
  const std::vector<int> length = compared ? common_lengths(a, b) : std::vector<int>();
  const auto left = [&](int i, int j) {
    return compared ? length[static_cast<std::size_t>(i) * static_cast<std::size_t>(b.size() + 1) +
                             static_cast<std::size_t>(j)]
                    : 0;
  };
  int i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    if (compared && i < a.size() && j < b.size() && a[i] == b[j]) {
      ++i;
      ++j;
    } else if (i < a.size() && (j == b.size() || left(i + 1, j) >= left(i, j + 1))) {
      found << "- " + a[i++];
    } else {
      found << "+ " + b[j++];
    }
  }
  return found;
}

}  // namespace breccia::gui
