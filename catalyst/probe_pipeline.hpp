#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "catalyst/pipeline.hpp"
#include "catalyst/pipeline_choice.hpp"
#include "catalyst/probe_sampling.hpp"
#include "catalyst/ranks.hpp"

class vtkDataArray;

namespace breccia::insitu {

/// Records what the elements have at points in space: folder/NAME.csv of each probe, a line a point and instant,
/// doubles to the last bit, the same on any number of ranks. Where no element is, the values are left out. A file of
/// the same columns that is already there is continued: its lines before the first new step stay. Written on the first
/// rank.
class ProbePipeline final : public Pipeline {
 public:
  /// @param fields  the arrays that are recorded; empty: all except those of ranks, rank and cost
  ProbePipeline(const Ranks& ranks, const std::vector<Probe>& probes, std::vector<std::string> fields,
                std::filesystem::path folder);

  std::uint32_t channels(std::int64_t step, double time) override;
  void execute(const Frame& frame, BrecciaRequests& requests) override;
  [[nodiscard]] std::int64_t bytes_written() const override { return bytes_; }

 private:
  struct Series {
    std::filesystem::path file;
    int points_a_row = 1;
    std::vector<Point> points;
    bool begun = false;
  };
  struct Elements {
    std::int64_t count = 0;
    const double* corners = nullptr;
    const std::int64_t* ids = nullptr;
    std::vector<vtkDataArray*> arrays;  ///< that are recorded
  };
  [[nodiscard]] Elements elements_of(const Frame& frame) const;
  [[nodiscard]] std::string sample(const Series& series, const Frame& frame, const Elements& elements) const;
  void write(Series& series, const Frame& frame, const std::string& header, const std::string& lines);

  const Ranks& ranks_;
  std::vector<std::string> fields_;
  std::vector<Series> series_;
  std::int64_t bytes_ = 0;
};

}  // namespace breccia::insitu
