#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include "peers.hpp"

namespace breccia::lab {
namespace {

namespace geometry = boost::geometry;
namespace index = boost::geometry::index;

template <class Number>
using Point = geometry::model::point<Number, 3, geometry::cs::cartesian>;
template <class Number>
using Tree = index::rtree<std::pair<Point<Number>, std::size_t>, index::rstar<16>>;

class BoostCells final : public Contender {
 public:
  std::string name() const override { return "boost_rtree"; }
  Tally detect(const Cells& cells) override {
    std::vector<std::pair<Point<int>, std::size_t>> values;
    for (std::size_t i = 0; i < cells.size(); ++i)
      values.emplace_back(Point<int>(cells[i][0], cells[i][1], cells[i][2]), i);
    const Tree<int> tree(values);
    Tally tally;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto& c = cells[i];
      const geometry::model::box<Point<int>> around({c[0] - 1, c[1] - 1, c[2] - 1}, {c[0] + 1, c[1] + 1, c[2] + 1});
      const auto take = [&](const auto& found) {
        if (found.second < i) tally.add(i, found.second);
      };
      tree.query(index::intersects(around), boost::make_function_output_iterator(take));
    }
    return tally;
  }
};

class BoostPoints final : public PointContender {
 public:
  std::string name() const override { return "boost_rtree"; }
  Tally detect(const std::vector<Vec3>& points, const std::vector<detection::Corners>& contactors,
               double buffer) override {
    const auto tests = couple_tests(contactors, buffer);
    const auto point_of = [](const Vec3& p) { return Point<double>(p[0], p[1], p[2]); };
    std::vector<std::pair<Point<double>, std::size_t>> values;
    for (const Vec3& p : points) values.emplace_back(point_of(p), values.size());
    const Tree<double> tree(values);
    Tally tally;
    for (std::size_t c = 0; c < tests.size(); ++c) {
      const geometry::model::box<Point<double>> box(point_of(tests[c].low()), point_of(tests[c].high()));
      const auto take = [&](const auto& found) {
        if (tests[c].in_planes(points[found.second])) tally.add(found.second, c);
      };
      tree.query(index::intersects(box), boost::make_function_output_iterator(take));
    }
    return tally;
  }
};

}  // namespace

void add_boost(Contenders& searches, PointContenders& point_searches) {
  searches.push_back(std::make_unique<BoostCells>());
  point_searches.push_back(std::make_unique<BoostPoints>());
}

}  // namespace breccia::lab
