#pragma once

#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "catalyst/link_watch.hpp"
#include "catalyst/pipeline.hpp"
#include "catalyst/ranks.hpp"

class vtkLiveInsituLink;
class vtkSMSession;
class vtkSMSessionProxyManager;
class vtkSMSourceProxy;

namespace breccia::insitu {

/// The link to a ParaView that listens on host:port (Catalyst > Connect), which may come and go: channels are published
/// as sources of their names, ParaView receives those it requests, and may pause and resume the run. Without a listener
/// no channel is requested from the solver and an attempt to connect is made at most every half second, and so that
/// attempts take at most 2 % of the time. Starts no Python. A pause blocks execute on all ranks until ParaView
/// continues or dies, or the run is to end. The connection is closed if ParaView does not respond within thirty
/// seconds.
class LivePipeline final : public Pipeline {
 public:
  /// @pre a CatalystBackend lives as long as this
  /// @param run  folder of the run, in the field data of the published channels: the array "run", its bytes
  /// @param run_ends  whether the run is requested to end; called on the first rank, by another thread
  LivePipeline(const Ranks& ranks, std::string host, int port, std::uint32_t channels, const std::string& run,
               std::function<bool()> run_ends);
  ~LivePipeline() override;

  std::uint32_t channels(std::int64_t step, double time) override;
  void execute(const Frame& frame, BrecciaRequests& requests) override;
  std::string notice() override;

 private:
  /// Runs a call of the link within a limit of time. @return  what the call returns
  template <class Call>
  auto limited(std::optional<std::chrono::milliseconds> limit, Call&& call);
  void publish(const Frame& frame);
  void withdraw();
  [[nodiscard]] bool paused_longer(BrecciaRequests& requests);

  const Ranks& ranks_;
  std::uint32_t mask_;
  vtkNew<vtkUnsignedCharArray> run_;
  vtkSmartPointer<vtkSMSession> session_;  ///< of its own: sources of scripts are not seen live
  vtkSMSessionProxyManager* proxies_ = nullptr;
  std::array<vtkSmartPointer<vtkSMSourceProxy>, BRECCIA_NUM_CHANNELS> sources_;
  vtkSmartPointer<vtkLiveInsituLink> link_;
  std::optional<LinkWatch> watch_;  ///< on the first rank
  bool connected_ = false;
  bool cut_ = false;                                    ///< on the first rank, since the last notice
  std::chrono::steady_clock::time_point next_attempt_;  ///< on the first rank
};

}  // namespace breccia::insitu
