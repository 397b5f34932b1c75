#include <cstdio>
#include <span>

#include "contender.hpp"
#include "detection/equal_size/bbts.hpp"
#include "detection/equal_size/cell_sweep.hpp"
#include "detection/equal_size/direct_search.hpp"
#include "detection/equal_size/mr.hpp"
#include "detection/equal_size/mr_s.hpp"
#include "detection/equal_size/nbs.hpp"

namespace breccia::lab {
namespace {

using namespace breccia::detection;

template <class Search>
class Own final : public Contender {
 public:
  std::string name() const override { return std::string(Search::name); }
  Tally detect(const Cells& cells) override {
    Tally tally;
    search_.detect(std::span<const BodyCell>(cells),
                   [&](Index a, Index b) { tally.add(static_cast<std::uint64_t>(a), static_cast<std::uint64_t>(b)); });
    return tally;
  }
  std::size_t bytes() const override { return search_.bytes(); }

 private:
  Search search_;
};

class OwnPoint final : public PointContender {
 public:
  OwnPoint(Algorithm algorithm, std::string name) : search_(make_search(algorithm, 0)), name_(std::move(name)) {}
  std::string name() const override { return name_; }
  Tally detect(const std::vector<Vec3>& points, const std::vector<Corners>& contactors, double buffer) override {
    search_->search(points, contactors, buffer, couples_);
    Tally tally;
    for (const Couple& c : couples_) {
      tally.add(static_cast<std::uint64_t>(c.point), static_cast<std::uint64_t>(c.contactor));
    }
    return tally;
  }

 private:
  std::unique_ptr<PointBodySearch> search_;
  std::string name_;
  std::vector<Couple> couples_;
};

/// After two calls, as the second may need storage that the first did not.
template <class Search, class C>
double bytes_a_body(const Cells& cells) {
  std::vector<Cell<3, C>> narrow;
  for (const BodyCell& cell : cells) {
    narrow.push_back({static_cast<C>(cell[0]), static_cast<C>(cell[1]), static_cast<C>(cell[2])});
  }
  Search search;
  std::uint64_t count = 0;
  for (int call = 0; call < 2; ++call) {
    search.detect(std::span<const Cell<3, C>>(narrow), [&](Index, Index) { ++count; });
    for (auto& cell : narrow) cell[0] = static_cast<C>(cell[0] + count % 2);
  }
  return static_cast<double>(search.bytes()) / static_cast<double>(cells.size());
}

template <template <int, std::signed_integral> class Search>
void write_bytes_of(const Cells& cells, std::ostream& table) {
  const std::string name(Search<3, std::int16_t>::name);
  const double narrow = bytes_a_body<Search<3, std::int16_t>, std::int16_t>(cells);
  const double wide = bytes_a_body<Search<3, std::int32_t>, std::int32_t>(cells);
  std::printf("%-12s %5.1f bytes a body, 16-bit coordinates; %5.1f, 32-bit\n", name.c_str(), narrow, wide);
  table << name << ',' << cells.size() << ',' << narrow << ',' << wide << '\n';
}

}  // namespace

Contenders own_searches() {
  Contenders all;
  all.push_back(std::make_unique<Own<DirectSearch<3, Coordinate>>>());
  all.push_back(std::make_unique<Own<Nbs<3, Coordinate>>>());
  all.push_back(std::make_unique<Own<Mr<3, Coordinate>>>());
  all.push_back(std::make_unique<Own<MrS<3, Coordinate>>>());
  all.push_back(std::make_unique<Own<Bbts<3, Coordinate>>>());
  all.push_back(std::make_unique<Own<CellSweep<3, Coordinate>>>());
  return all;
}

PointContenders own_point_searches() {
  PointContenders all;
  all.push_back(std::make_unique<OwnPoint>(Algorithm::ms, "ms"));
  all.push_back(std::make_unique<OwnPoint>(Algorithm::ms_slices, "ms_slices"));
  all.push_back(std::make_unique<OwnPoint>(Algorithm::sorted_grid, "sorted_grid"));
  all.push_back(std::make_unique<OwnPoint>(Algorithm::packed_tree, "packed_tree"));
  return all;
}

void write_bytes(std::size_t n, std::ostream& table) {
  const Placement placement("III", n, 1);
  write_bytes_of<Nbs>(placement.cells(), table);
  write_bytes_of<Mr>(placement.cells(), table);
  write_bytes_of<MrS>(placement.cells(), table);
  write_bytes_of<Bbts>(placement.cells(), table);
  write_bytes_of<CellSweep>(placement.cells(), table);
}

}  // namespace breccia::lab
