#include "catalyst/live_pipeline.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkFieldData.h>
#include <vtkLiveInsituLink.h>
#include <vtkNew.h>
#include <vtkPVTrivialProducer.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProcessModule.h>
#include <vtkSMProxyManager.h>
#include <vtkSMSession.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>
#include <vtkTable.h>

#include <algorithm>
#include <utility>

#include "catalyst/frame_to_vtk.hpp"
#include "catalyst/messages.hpp"

namespace breccia::insitu {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kBetweenAttempts = std::chrono::milliseconds(500);
constexpr auto kLongestRest = std::chrono::seconds(5);  ///< after an attempt that was refused
constexpr int kAttemptShare = 50;                       ///< an attempt that took t is followed by 50 t without one

constexpr auto kPatience = std::chrono::seconds(30);  // a ParaView that draws may take long
constexpr auto kRestAfterSilence = std::chrono::minutes(1);

/// The link joins what ranks send, but for tables, which get lost: rows become points.
vtkSmartPointer<vtkDataObject> sendable(vtkDataObject* object) {
  auto* table = vtkTable::SafeDownCast(object);
  if (table == nullptr) {  // other pipelines have the object too
    const auto copy = vtkSmartPointer<vtkDataObject>::Take(object->NewInstance());
    copy->ShallowCopy(object);
    return copy;
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row) {
    points->InsertNextPoint(0, 0, 0);
    vertices->InsertNextCell(1, &row);
  }
  auto rows = vtkSmartPointer<vtkPolyData>::New();
  rows->SetPoints(points);
  rows->SetVerts(vertices);
  rows->GetCellData()->ShallowCopy(table->GetRowData());
  return rows;
}

}  // namespace

LivePipeline::LivePipeline(const Ranks& ranks, std::string host, int port, std::uint32_t channels,
                           const std::string& run, std::function<bool()> run_ends)
    : ranks_(ranks), mask_(channels), next_attempt_(Clock::now()) {
  run_->SetName("run");
  for (const char c : run) run_->InsertNextValue(static_cast<unsigned char>(c));
  session_ = vtkSmartPointer<vtkSMSession>::New();
  vtkProcessModule::GetProcessModule()->RegisterSession(session_);
  proxies_ = vtkSMProxyManager::GetProxyManager()->GetSessionProxyManager(session_);
  for (int channel = 0; channel < BRECCIA_NUM_CHANNELS; ++channel) {
    if ((mask_ & bit(channel)) == 0) continue;
    const auto index = static_cast<std::size_t>(channel);
    auto proxy = vtkSmartPointer<vtkSMProxy>::Take(proxies_->NewProxy("sources", "PVTrivialProducer"));
    sources_[index] = vtkSMSourceProxy::SafeDownCast(proxy);
    if (!sources_[index]) throw PipelineError("ParaView has no trivial producer");
    sources_[index]->UpdateVTKObjects();
    proxies_->RegisterProxy("sources", kChannelNames[index], sources_[index]);
  }
  link_ = vtkSmartPointer<vtkLiveInsituLink>::New();
  link_->SetHostname(host.c_str());
  link_->SetInsituPort(port);
  link_->SetProcessType(vtkLiveInsituLink::INSITU);
  if (ranks_.is_root()) watch_.emplace(port, std::move(run_ends));
}

LivePipeline::~LivePipeline() {
  link_ = nullptr;
  sources_ = {};
  if (vtkProcessModule* module = vtkProcessModule::GetProcessModule(); module != nullptr)
    module->UnRegisterSession(session_);
}

template <class Call>
auto LivePipeline::limited(std::optional<std::chrono::milliseconds> limit, Call&& call) {
  if (watch_) watch_->begin(limit);
  const auto result = call();
  if (watch_ && watch_->end() && limit) cut_ = true;
  return result;
}

std::string LivePipeline::notice() {
  if (ranks_.from_root(std::int64_t{std::exchange(cut_, false)}) == 0) return {};
  return "warning: ParaView did not respond within 30 s; the connection was closed\n";
}

std::uint32_t LivePipeline::channels(std::int64_t, double) {
  if (connected_) return mask_;
  if (ranks_.from_root(std::int64_t{Clock::now() >= next_attempt_}) == 0) return 0;
  const auto begin = Clock::now();
  connected_ = limited(kPatience, [this] { return link_->Initialize(proxies_); });
  const Clock::duration rest = kAttemptShare * (Clock::now() - begin);
  next_attempt_ = Clock::now() + (cut_ ? Clock::duration(kRestAfterSilence)
                                       : std::clamp<Clock::duration>(rest, kBetweenAttempts, kLongestRest));
  static_cast<void>(take_errors());  // no ParaView listens there: not an error
  return connected_ ? mask_ : 0;
}

void LivePipeline::publish(const Frame& frame) {
  for (std::size_t channel = 0; channel < sources_.size(); ++channel) {
    if (!sources_[channel]) continue;
    auto* producer = vtkPVTrivialProducer::SafeDownCast(sources_[channel]->GetClientSideObject());
    const auto data = sendable(frame.channels[channel]);
    vtkNew<vtkFieldData> about;
    about->ShallowCopy(frame.channels[channel]->GetFieldData());
    about->AddArray(run_);
    data->SetFieldData(about);
    producer->SetOutput(data, frame.time);
    sources_[channel]->MarkModified(sources_[channel]);
    sources_[channel]->UpdatePipeline(frame.time);
  }
}

/// Waits until ParaView wants something. @return  whether the run stays paused
bool LivePipeline::paused_longer(BrecciaRequests& requests) {
  const auto begin = Clock::now();
  const bool stays = limited({}, [this] { return link_->WaitForLiveChange(); }) == 0;
  requests.waited += std::chrono::duration<double>(Clock::now() - begin).count();
  return stays;
}

void LivePipeline::withdraw() {
  for (const auto& source : sources_) {
    if (!source) continue;
    auto* producer = vtkPVTrivialProducer::SafeDownCast(source->GetClientSideObject());
    producer->SetOutput(empty_like(producer->GetOutputDataObject(0)));
  }
}

void LivePipeline::execute(const Frame& frame, BrecciaRequests& requests) {
  publish(frame);
  // Each turn sends what ParaView has requested; while it pauses the run, a turn follows each of its requests.
  const auto turn = [&] {
    const bool connected = link_->Initialize(proxies_);
    if (connected) link_->InsituUpdate(frame.time, frame.step);
    if (connected) link_->InsituPostProcess(frame.time, frame.step);
    return connected;
  };
  do {
    connected_ = limited(kPatience, turn);
    if (!connected_) break;
  } while (link_->GetSimulationPaused() != 0 && paused_longer(requests));
  // Not at once again to one that did not answer.
  if (cut_) next_attempt_ = Clock::now() + kRestAfterSilence;
  withdraw();
  static_cast<void>(take_errors());  // a closed ParaView is no failure of the run
}

}  // namespace breccia::insitu
