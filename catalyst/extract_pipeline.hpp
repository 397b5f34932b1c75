#pragma once

#include <filesystem>
#include <vector>

#include "catalyst/extract_files.hpp"
#include "catalyst/pipeline.hpp"
#include "catalyst/ranks.hpp"

namespace breccia::insitu {

/// Records a channel of cells: see extract_files.hpp. A recording of the same name that is already there is continued:
/// its instants before the first new step stay.
class ExtractPipeline final : public Pipeline {
 public:
  /// @param folder of the channel; made when the first instant comes
  ExtractPipeline(const Ranks& ranks, int channel, std::filesystem::path folder);

  std::uint32_t channels(std::int64_t step, double time) override;
  void execute(const Frame& frame, BrecciaRequests& requests) override;
  [[nodiscard]] std::int64_t bytes_written() const override { return bytes_; }

 private:
  void index(const Frame& frame, vtkDataObject* object);

  const Ranks& ranks_;
  int channel_;
  std::filesystem::path folder_;
  std::vector<RecordedInstant> instants_;  ///< of the .pvd; on the first rank
  bool begun_ = false;
  std::int64_t bytes_ = 0;
};

/// Records the history: folder/history.csv, one line a row, doubles to the last bit. On the first rank.
class HistoryPipeline final : public Pipeline {
 public:
  HistoryPipeline(const Ranks& ranks, std::filesystem::path folder);

  std::uint32_t channels(std::int64_t step, double time) override;
  void execute(const Frame& frame, BrecciaRequests& requests) override;
  [[nodiscard]] std::int64_t bytes_written() const override { return bytes_; }

 private:
  const Ranks& ranks_;
  std::filesystem::path file_;
  bool begun_ = false;
  std::int64_t bytes_ = 0;
};

}  // namespace breccia::insitu
