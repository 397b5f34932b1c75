#pragma once

#include <memory>
#include <utility>

#include "catalyst/pipeline.hpp"
#include "catalyst/ranks.hpp"

namespace breccia::insitu {

/// A pipeline that works on the first rank alone, on frames of which that rank has all cells; the others wait for it
/// and learn what it wants and fails of.
class FirstRankPipeline final : public Pipeline {
 public:
  /// @param work  on the first rank; null on the others
  FirstRankPipeline(const Ranks& ranks, std::unique_ptr<Pipeline> work) : ranks_(ranks), work_(std::move(work)) {}

  std::uint32_t channels(std::int64_t step, double time) override {
    std::int64_t mask = 0;
    std::string error;
    try {
      if (work_) mask = work_->channels(step, time);
    } catch (const PipelineError& failure) {
      error = failure.what();
    }
    ranks_.throw_agreed(error);
    return static_cast<std::uint32_t>(ranks_.from_root(mask));
  }
  void execute(const Frame& frame, BrecciaRequests& requests) override {
    if (work_) work_->execute(frame, requests);
  }
  [[nodiscard]] std::string notice() override { return ranks_.agree(work_ ? work_->notice() : std::string()); }
  [[nodiscard]] std::int64_t bytes_written() const override { return work_ ? work_->bytes_written() : 0; }
  [[nodiscard]] bool draws() const override { return true; }
  void finish() override {
    if (work_) work_->finish();
  }

 private:
  const Ranks& ranks_;
  std::unique_ptr<Pipeline> work_;
};

}  // namespace breccia::insitu
