#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "catalyst/catalyst_backend.hpp"
#include "catalyst/display.hpp"
#include "catalyst/frame_to_vtk.hpp"
#include "catalyst/gathered_instant.hpp"
#include "catalyst/pipeline.hpp"
#include "catalyst/ranks.hpp"
#include "catalyst/selection.hpp"

namespace breccia::insitu {

/// The pipelines of a run, ready to be executed. Members are collective unless stated otherwise.
class Adaptor {
 public:
  /// Starts what the pipelines need and no more: ParaView for scripts and the live link, Python for scripts, a display
  /// for pictures. Throws PipelineError, on all ranks.
  /// @param frames_of_others  frames come from elsewhere than the ranks' instants: all ranks work on their own
  explicit Adaptor(const BrecciaConfig& config, bool frames_of_others = false);
  Adaptor(const Adaptor&) = delete;
  Adaptor& operator=(const Adaptor&) = delete;
  ~Adaptor();

  [[nodiscard]] const Ranks& ranks() const { return ranks_; }
  [[nodiscard]] int num_pipelines() const { return static_cast<int>(pipelines_.size()); }
  [[nodiscard]] const std::string& name(int pipeline) const {
    return pipelines_.at(static_cast<std::size_t>(pipeline)).name;
  }

  /// Channels that a pipeline wants; 0: nothing to do.
  [[nodiscard]] std::uint32_t channels(int pipeline, std::int64_t step, double time);

  /// Executes pipelines; those that fail on any rank are returned and add a line "name: what" to `text`.
  std::uint32_t execute(std::uint32_t pipelines, const BrecciaInstant& instant, BrecciaRequests& requests,
                        std::string& text);
  /// The same on a frame, which all pipelines get whole.
  std::uint32_t execute(std::uint32_t pipelines, const Frame& frame, BrecciaRequests& requests, std::string& text);

  /// Notices since the last call, failures excluded, a line each; the same on all ranks.
  [[nodiscard]] std::string notices();

  /// Ends the pipelines and makes animations of their pictures; nothing can be executed afterwards.
  /// @return  notices of the end, and lines about the animations, on the first rank
  [[nodiscard]] std::string finish();

  /// On this rank; not collective.
  [[nodiscard]] std::int64_t bytes_written(int pipeline) const {
    return pipelines_.at(static_cast<std::size_t>(pipeline)).work->bytes_written();
  }

 private:
  /// Of an instant, for a pipeline that does not get all of this rank's, or all ranks'.
  struct Part {
    explicit Part(const Selection& selection) : instant(selection) {}
    [[nodiscard]] Frame of(const BrecciaInstant& whole) {
      const BrecciaInstant& selected = instant.of(whole);
      return frames.wrap(all ? all->of(selected) : selected);
    }
    SelectedInstant instant;
    std::unique_ptr<GatheredInstant> all;  ///< null: this rank's
    FrameToVtk frames;
  };
  struct Named {
    std::string name;
    std::unique_ptr<Pipeline> work;
    std::unique_ptr<Part> part;  ///< null: it gets all
  };

  [[nodiscard]] std::vector<Frame> frames_of(std::uint32_t pipelines, const BrecciaInstant& instant);
  std::uint32_t execute(std::uint32_t pipelines, const std::vector<Frame>& frames, BrecciaRequests& requests,
                        std::string& text);
  void end_pipelines();
  void start_display(const BrecciaConfig& config);
  [[nodiscard]] std::unique_ptr<Pipeline> made(const BrecciaPipeline& pipeline, const BrecciaConfig& config);
  CatalystBackend& backend();

  Ranks ranks_;
  /// The first rank alone draws, where ParaView is needed for pictures of our own and nothing else: the others save its
  /// memory. Null: all do.
  std::unique_ptr<Ranks> alone_;
  SelectedInstant whole_{Selection{}};  ///< without the values at points that others have requested
  FrameToVtk frames_;
  std::vector<std::uint32_t> script_channels_;  ///< by pipeline; of scripts
  std::uint32_t script_draws_ = 0;              ///< mask of the pipelines that make pictures
  std::unique_ptr<Display> display_;
  std::unique_ptr<CatalystBackend> backend_;
  std::vector<Named> pipelines_;
  std::filesystem::path folder_;
  bool finished_ = false;
};

}  // namespace breccia::insitu
