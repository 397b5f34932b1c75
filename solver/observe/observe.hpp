#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "domains/partition.hpp"
#include "observe/fragment_labels.hpp"
#include "observe/gauges.hpp"
#include "observe/point_gauges.hpp"
#include "output/frames/frame.hpp"

namespace breccia {

/// Samples a running partition for the history and for frames; read only. All members are collective.
class Observer {
 public:
  /// @pre input and partition outlive this object
  Observer(const case_::Case& input, const Partition& partition)
      : input_(input), partition_(partition), point_gauges_(input) {}

  /// Throws InputError where a point of a gauge is outside of the model.
  void check_points() { point_gauges_.find(partition_.domain()); }

  /// From now on gauges read the constraints of this stage. @pre stage outlives its use
  void begin_stage(const case_::Stage& stage);

  /// One line of the history of the whole model: budget and gauges of the last step, under the number that a frame of
  /// its beginning has. @param time  s, of that step
  /// @pre that step was sampled
  [[nodiscard]] HistoryRow row(double time);
  /// A picture of this rank's originals as they are. @param parts  the others stay empty
  [[nodiscard]] Frame picture(std::int64_t number, const FrameParts& parts);
  /// How many fragments the whole model is in.
  [[nodiscard]] std::int64_t num_fragments() { return labels().count; }

 private:
  void make_gauges();
  [[nodiscard]] const Fragments& labels() { return fragments_.look(partition_.domain(), partition_.decompositions()); }

  const case_::Case& input_;
  const Partition& partition_;
  const case_::Stage* stage_ = nullptr;
  std::vector<Gauge> gauges_;
  PointGauges point_gauges_;
  std::int64_t gauged_ = 0;  ///< decomposition for which the gauges were made
  FragmentWatch fragments_;
};

}  // namespace breccia
