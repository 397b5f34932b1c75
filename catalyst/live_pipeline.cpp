#include "catalyst/live_pipeline.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
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

#include "catalyst/frame_to_vtk.hpp"
#include "catalyst/messages.hpp"

namespace breccia::insitu {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kBetweenAttempts = std::chrono::milliseconds(500);
constexpr int kAttemptShare = 50;  ///< an attempt that took t is followed by 50 t without one

/// The link joins what ranks send, but for tables, which get lost: rows become points.
vtkSmartPointer<vtkDataObject> sendable(vtkDataObject* object) {
  auto* table = vtkTable::SafeDownCast(object);
  if (table == nullptr) return object;
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
  rows->GetFieldData()->ShallowCopy(table->GetFieldData());
  return rows;
}

}  // namespace

LivePipeline::LivePipeline(const Ranks& ranks, std::string host, int port, std::uint32_t channels)
    : ranks_(ranks), mask_(channels), next_attempt_(Clock::now()) {
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
}

LivePipeline::~LivePipeline() {
  link_ = nullptr;
  sources_ = {};
  if (vtkProcessModule* module = vtkProcessModule::GetProcessModule(); module != nullptr)
    module->UnRegisterSession(session_);
}

std::uint32_t LivePipeline::channels(std::int64_t, double) {
  if (connected_) return mask_;
  if (ranks_.from_root(std::int64_t{Clock::now() >= next_attempt_}) == 0) return 0;
  const auto begin = Clock::now();
  connected_ = link_->Initialize(proxies_);
  next_attempt_ = Clock::now() + std::max<Clock::duration>(kBetweenAttempts, kAttemptShare * (Clock::now() - begin));
  static_cast<void>(take_errors());  // nobody listens: not an error
  return connected_ ? mask_ : 0;
}

void LivePipeline::publish(const Frame& frame) {
  for (std::size_t channel = 0; channel < sources_.size(); ++channel) {
    if (!sources_[channel]) continue;
    auto* producer = vtkPVTrivialProducer::SafeDownCast(sources_[channel]->GetClientSideObject());
    producer->SetOutput(sendable(frame.channels[channel]), frame.time);
    sources_[channel]->MarkModified(sources_[channel]);
    sources_[channel]->UpdatePipeline(frame.time);
  }
}

/// Waits until ParaView wants something. @return  whether the run stays paused
bool LivePipeline::paused_longer(BrecciaRequests& requests) {
  const auto begin = Clock::now();
  const bool stays = link_->WaitForLiveChange() == 0;
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
  // Each turn sends what ParaView has asked for; while it pauses the run, a turn follows each of its wishes.
  do {
    connected_ = link_->Initialize(proxies_);
    if (!connected_) break;
    link_->InsituUpdate(frame.time, frame.step);
    link_->InsituPostProcess(frame.time, frame.step);
  } while (link_->GetSimulationPaused() != 0 && paused_longer(requests));
  withdraw();
  static_cast<void>(take_errors());  // a ParaView that has gone is no failure of the run
}

}  // namespace breccia::insitu
