#include "parallel/exchange_schedule.hpp"

#include <algorithm>
#include <string>

#include "base/error.hpp"

namespace breccia {
namespace {

constexpr int kNoPartner = -1;

/// Edges of a graph that get colours so that no two at a vertex have the same.
class EdgeColours {
 public:
  EdgeColours(std::size_t vertices, std::size_t colours)
      : colours_(colours), partner_(vertices * colours, kNoPartner) {}

  /// Gives the edge u v a colour; others may change theirs. @pre it has none; both have fewer coloured edges than
  /// colours - 1
  void add(int u, int v) {
    std::vector<Spoke> fan = fan_of(u, v);
    const std::size_t c = free_at(u), d = free_at(fan.back().vertex);
    invert_path(u, c, d);
    for (std::size_t i = 0; i < fan.size(); ++i) {
      if (fan[i].colour == d) fan[i].colour = c;  // as the path has left it
      if (!is_free(fan[i].vertex, d)) continue;
      fan.resize(i + 1, fan[0]);
      return rotate(u, fan, d);
    }
    DEMAND(false, "no place for the pair " + std::to_string(u) + " " + std::to_string(v));
  }

  [[nodiscard]] int partner(int vertex, std::size_t colour) const { return partner_[at(vertex, colour)]; }

 private:
  /// A neighbour of the fan's centre and the colour of the edge to it.
  struct Spoke {
    int vertex;
    std::size_t colour;
  };

  [[nodiscard]] std::size_t at(int vertex, std::size_t colour) const {
    return static_cast<std::size_t>(vertex) * colours_ + colour;
  }
  [[nodiscard]] bool is_free(int vertex, std::size_t colour) const { return partner(vertex, colour) == kNoPartner; }
  [[nodiscard]] std::size_t free_at(int vertex) const {
    std::size_t colour = 0;
    while (!is_free(vertex, colour)) ++colour;
    return colour;
  }
  void set(int u, int v, std::size_t colour) {
    partner_[at(u, colour)] = v;
    partner_[at(v, colour)] = u;
  }
  void unset(int u, int v, std::size_t colour) {
    partner_[at(u, colour)] = kNoPartner;
    partner_[at(v, colour)] = kNoPartner;
  }

  /// Neighbours of u from v on, the edge to each of a colour that the one before lacks; as long as can be.
  [[nodiscard]] std::vector<Spoke> fan_of(int u, int v) const {
    std::vector<Spoke> fan{{v, colours_}};
    for (bool grown = true; grown;) {
      grown = false;
      for (std::size_t colour = 0; colour < colours_ && !grown; ++colour) {
        const int w = partner(u, colour);
        const auto is_w = [&](const Spoke& spoke) { return spoke.vertex == w; };
        if (w == kNoPartner || !is_free(fan.back().vertex, colour) || std::any_of(fan.begin(), fan.end(), is_w))
          continue;
        fan.push_back({w, colour});
        grown = true;
      }
    }
    return fan;
  }

  /// Swaps c and d along the path of these colours that begins at u, where c is free: then d is.
  void invert_path(int u, std::size_t c, std::size_t d) {
    std::vector<int> path{u};
    for (std::size_t colour = d; c != d && !is_free(path.back(), colour); colour = colour == d ? c : d) {
      path.push_back(partner(path.back(), colour));
    }
    for (std::size_t i = 0; i + 1 < path.size(); ++i) unset(path[i], path[i + 1], i % 2 == 0 ? d : c);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) set(path[i], path[i + 1], i % 2 == 0 ? c : d);
  }

  /// Each edge of the fan gets the colour of the next, the last one d.
  void rotate(int u, const std::vector<Spoke>& fan, std::size_t d) {
    for (std::size_t i = 1; i < fan.size(); ++i) {
      DEMAND(partner(u, fan[i].colour) == fan[i].vertex && is_free(fan[i - 1].vertex, fan[i].colour),
             "a fan that is none");
      unset(u, fan[i].vertex, fan[i].colour);
    }
    for (std::size_t i = 1; i < fan.size(); ++i) set(u, fan[i - 1].vertex, fan[i].colour);
    set(u, fan.back().vertex, d);
  }

  std::size_t colours_;
  std::vector<int> partner_;  ///< (vertices, colours) the other vertex of the edge of a colour; -1: none
};

}  // namespace

std::vector<std::vector<RankPair>> exchange_schedule(std::vector<RankPair> pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<std::size_t> degree;
  for (const RankPair& pair : pairs) {
    DEMAND(0 <= pair.a && pair.a < pair.b, std::to_string(pair.a) + " " + std::to_string(pair.b));
    if (degree.size() <= static_cast<std::size_t>(pair.b)) degree.resize(static_cast<std::size_t>(pair.b) + 1);
    for (const int rank : {pair.a, pair.b}) ++degree[static_cast<std::size_t>(rank)];
  }
  if (pairs.empty()) return {};
  const std::size_t colours = *std::max_element(degree.begin(), degree.end()) + 1;
  EdgeColours edges(degree.size(), colours);
  for (const RankPair& pair : pairs) edges.add(pair.a, pair.b);

  std::vector<std::vector<RankPair>> steps(colours);
  for (std::size_t colour = 0; colour < colours; ++colour) {
    for (int rank = 0; rank < static_cast<int>(degree.size()); ++rank) {
      const int other = edges.partner(rank, colour);
      if (other > rank) steps[colour].push_back({rank, other});
    }
  }
  std::erase_if(steps, [](const std::vector<RankPair>& step) { return step.empty(); });
  return steps;
}

}  // namespace breccia
