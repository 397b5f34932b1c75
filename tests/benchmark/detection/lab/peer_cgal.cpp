#include <CGAL/box_intersection_d.h>

#include "peers.hpp"

namespace breccia::lab {
namespace {

/// Box with the number of its body; closed, so that boxes that share a border meet.
template <class Number>
struct NumberedBox : CGAL::Box_intersection_d::Box_d<Number, 3, CGAL::Box_intersection_d::ID_EXPLICIT> {
  using Base = CGAL::Box_intersection_d::Box_d<Number, 3, CGAL::Box_intersection_d::ID_EXPLICIT>;
  NumberedBox(Number low[3], Number high[3], std::size_t body) : Base(low, high), number(body) {}
  std::size_t number;
};

class CgalCells final : public Contender {
 public:
  std::string name() const override { return "cgal"; }
  Tally detect(const Cells& cells) override {
    boxes_.clear();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      int low[3], high[3];
      for (std::size_t axis = 0; axis < 3; ++axis) high[axis] = (low[axis] = cells[i][axis]) + 1;
      boxes_.emplace_back(low, high, i);
    }
    Tally tally;
    CGAL::box_self_intersection_d(boxes_.begin(), boxes_.end(),
                                  [&](const auto& a, const auto& b) { tally.add(a.number, b.number); });
    return tally;
  }
  std::size_t bytes() const override { return boxes_.capacity() * sizeof(NumberedBox<int>); }

 private:
  std::vector<NumberedBox<int>> boxes_;
};

class CgalPoints final : public PointContender {
 public:
  std::string name() const override { return "cgal"; }
  Tally detect(const std::vector<Vec3>& points, const std::vector<detection::Corners>& contactors,
               double buffer) override {
    const auto tests = couple_tests(contactors, buffer);
    std::vector<NumberedBox<double>> point_boxes, contactor_boxes;
    const auto add = [](auto& boxes, Vec3 low, Vec3 high) {
      boxes.emplace_back(low.data(), high.data(), boxes.size());
    };
    for (const Vec3& p : points) add(point_boxes, p, p);
    for (const auto& test : tests) add(contactor_boxes, test.low(), test.high());
    Tally tally;
    CGAL::box_intersection_d(point_boxes.begin(), point_boxes.end(), contactor_boxes.begin(), contactor_boxes.end(),
                             [&](const auto& point, const auto& contactor) {
                               if (tests[contactor.number].holds(points[point.number]))
                                 tally.add(point.number, contactor.number);
                             });
    return tally;
  }
};

}  // namespace

void add_cgal(Contenders& searches, PointContenders& point_searches) {
  searches.push_back(std::make_unique<CgalCells>());
  point_searches.push_back(std::make_unique<CgalPoints>());
}

}  // namespace breccia::lab
