#include <nanoflann.hpp>

#include "peers.hpp"

namespace breccia::lab {
namespace {

/// Positions as nanoflann reads them.
template <class Number, class Positions>
struct Cloud {
  const Positions& positions;
  std::size_t kdtree_get_point_count() const { return positions.size(); }
  Number kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return static_cast<Number>(positions[i][static_cast<Axis>(axis)]);
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
  using Axis = std::conditional_t<std::is_same_v<Positions, Cells>, std::size_t, Eigen::Index>;
};

template <class Number, class Positions>
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<Number, Cloud<Number, Positions>>,
                                                 Cloud<Number, Positions>, 3, std::size_t>;

/// Takes every point within a distance as it is found, without a list.
template <class Number, class Take>
struct Ball {
  Number square;
  Take take;
  Number worstDist() const { return square; }
  bool full() const { return true; }
  bool addPoint(Number distance, std::size_t i) {
    if (distance < square) take(i);
    return true;
  }
};

template <class AnyTree, class Number, class Take>
void search_ball(const AnyTree& tree, const Number* centre, Number square, Take take) {
  Ball<Number, Take> ball{square, take};
  tree.findNeighbors(ball, centre, nanoflann::SearchParams());
}

class NanoflannCells final : public Contender {
 public:
  std::string name() const override { return "nanoflann"; }
  /// Whole coordinates differ by one at most exactly where the square of their distance is 3 at most.
  Tally detect(const Cells& cells) override {
    const Cloud<float, Cells> cloud{cells};
    Tree<float, Cells> tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    tree.buildIndex();
    Tally tally;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const float centre[3] = {static_cast<float>(cells[i][0]), static_cast<float>(cells[i][1]),
                               static_cast<float>(cells[i][2])};
      search_ball(tree, centre, 3.5F, [&](std::size_t other) {
        if (other < i) tally.add(i, other);
      });
    }
    return tally;
  }
};

class NanoflannPoints final : public PointContender {
 public:
  std::string name() const override { return "nanoflann"; }
  /// It searches balls only: the one around the box.
  Tally detect(const std::vector<Vec3>& points, const std::vector<detection::Corners>& contactors,
               double buffer) override {
    const auto tests = couple_tests(contactors, buffer);
    const Cloud<double, std::vector<Vec3>> cloud{points};
    Tree<double, std::vector<Vec3>> tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    tree.buildIndex();
    Tally tally;
    for (std::size_t c = 0; c < tests.size(); ++c) {
      const Vec3 centre = 0.5 * (tests[c].low() + tests[c].high());
      const double square = (tests[c].high() - centre).squaredNorm() * (1 + 1e-12);  // no corner is lost to round-off
      search_ball(tree, centre.data(), square, [&](std::size_t p) {
        if (tests[c].holds(points[p])) tally.add(p, c);
      });
    }
    return tally;
  }
};

}  // namespace

void add_nanoflann(Contenders& searches, PointContenders& point_searches) {
  searches.push_back(std::make_unique<NanoflannCells>());
  point_searches.push_back(std::make_unique<NanoflannPoints>());
}

}  // namespace breccia::lab
