#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "output/sink.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

/// Informs the sinks of this rank; all ranks do the same.
class SinkGroup {
 public:
  /// @pre sinks outlive this object
  SinkGroup(const std::vector<std::unique_ptr<Sink>>& sinks, const Communicator& communicator)
      : sinks_(sinks), communicator_(communicator) {}

  /// An error on one rank is an error on all. Collective. @param tell_one  called with each sink
  template <class Tell>
  void tell(Tell&& tell_one) {
    communicator_.set_phase("output");
    // By itself: only one rank may have such an error, while sinks speak with those of other ranks.
    communicator_.agree([&] {
      if (const std::optional<OutputError> late = std::exchange(late_, std::nullopt)) throw OutputError(*late);
    });
    communicator_.agree([&] {
      for (const auto& sink : sinks_) tell_one(*sink);
    });
  }

  /// Not collective, for only the clock of the rank with such a sink knows when: what goes wrong waits until all ranks
  /// speak next.
  /// @param make_line  of the status, called when a sink would use one
  template <class MakeLine>
  void tell_status(MakeLine&& make_line) {
    try {
      for (const auto& sink : sinks_) {
        if (sink->status_due()) sink->status(make_line());
      }
    } catch (const OutputError& error) {
      if (!late_) late_ = error;
    }
  }

  /// How far the files of this rank's sinks are.
  [[nodiscard]] OutputMarks marks() const {
    OutputMarks marks;
    for (const auto& sink : sinks_) sink->mark(marks);
    return marks;
  }

 private:
  const std::vector<std::unique_ptr<Sink>>& sinks_;
  Communicator communicator_;
  std::optional<OutputError> late_;
};

}  // namespace breccia
