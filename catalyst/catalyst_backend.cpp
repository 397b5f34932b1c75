#include "catalyst/catalyst_backend.hpp"

#include <mpi.h>
#include <vtkCPDataDescription.h>
#include <vtkCPInputDataDescription.h>
#include <vtkCPProcessor.h>
#include <vtkCPPythonScriptV2Pipeline.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkMPI.h>
#include <vtkNew.h>
#include <vtkPVTrivialProducer.h>
#include <vtkPVVersion.h>
#include <vtkSMProxy.h>
#include <vtkSMProxyIterator.h>
#include <vtkSMProxyManager.h>
#include <vtkSMSessionProxyManager.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "catalyst/folders.hpp"
#include "catalyst/frame_to_vtk.hpp"
#include "catalyst/messages.hpp"
#include "catalyst/own_mpi.hpp"
#include "catalyst/pipeline_loop.hpp"
#include "catalyst/python_guard.hpp"

namespace breccia::insitu {
namespace {

/// The requests as arrays of one value in the user data of a description.
class UserData {
 public:
  UserData() {
    int_value("stop");
    int_value("pause");
    int_value("extract");
    vtkNew<vtkDoubleArray> interval;
    interval->SetName("frame_interval");
    interval->InsertNextValue(0.0);
    data_->AddArray(interval);
  }
  [[nodiscard]] vtkFieldData* data() { return data_; }
  void add_to(BrecciaRequests& requests) {
    requests.stop |= static_cast<std::int32_t>(value("stop") != 0.0);
    requests.pause |= static_cast<std::int32_t>(value("pause") != 0.0);
    requests.extract |= static_cast<std::int32_t>(value("extract") != 0.0);
    if (const double interval = value("frame_interval"); interval > 0.0) requests.frame_interval = interval;
  }

 private:
  void int_value(const char* name) {
    vtkNew<vtkIntArray> array;
    array->SetName(name);
    array->InsertNextValue(0);
    data_->AddArray(array);
  }
  /// 0 when the script has removed or emptied the array.
  [[nodiscard]] double value(const char* name) {
    vtkDataArray* array = data_->GetArray(name);
    return array == nullptr || array->GetNumberOfTuples() < 1 ? 0.0 : array->GetComponent(0, 0);
  }

  vtkNew<vtkFieldData> data_;
};

/// The producers keep the last data that they were given: empty ones take their place, so that nothing of the solver's
/// memory is read before the next execution.
void empty_producers() {
  vtkNew<vtkSMProxyIterator> proxies;
  proxies->SetSessionProxyManager(vtkSMProxyManager::GetProxyManager()->GetActiveSessionProxyManager());
  proxies->SetModeToOneGroup();
  for (proxies->Begin("sources"); proxies->IsAtEnd() == 0; proxies->Next()) {
    auto* producer = vtkPVTrivialProducer::SafeDownCast(proxies->GetProxy()->GetClientSideObject());
    if (producer == nullptr || producer->GetOutputDataObject(0) == nullptr) continue;
    const auto empty = empty_like(producer->GetOutputDataObject(0));
    double time = 0.0;
    if (vtkDataArray* times = empty->GetFieldData()->GetArray("TimeValue"); times != nullptr)
      time = times->GetComponent(0, 0);
    producer->SetOutput(empty, time);
    proxies->GetProxy()->MarkModified(proxies->GetProxy());
  }
}

/// Warnings of ParaView's for which no script is to blame: channels have one time, and may be without cells.
bool is_of_channels(const std::string& warning) {
  return warning.starts_with("vtkPVTrivialProducer: ") ||
         warning.starts_with("vtkSMPVRepresentationProxy: Could not determine array range");
}

class ScriptPipeline final : public Pipeline {
 public:
  ScriptPipeline(const Ranks& ranks, ScriptWatch& watch, ScriptDescription description)
      : ranks_(ranks), watch_(watch), is_(std::move(description)) {
    const ScriptWatch::Turn turn(watch_, "pipeline " + is_.name);
    enter();
    const bool registered = script_->Initialize(is_.file.c_str());
    const std::string error = error_now();
    if (!registered || !error.empty())
      throw PipelineError(error.empty() ? is_.file.string() + ": cannot be loaded" : error);
    written_before_ = bytes_in_folder(is_.folder);
  }

  std::uint32_t channels(std::int64_t step, double time) override {
    if (!pending_.empty()) return is_.channels;
    const std::string why = ranks_.agree(reason_to_end());
    if (why == kDropped) return 0;
    if (!why.empty()) {  // executed once more, so that it is reported
      pending_ = why;
      dropped_ = true;
      return is_.channels;
    }
    const ScriptWatch::Turn turn(watch_, "pipeline " + is_.name);
    const auto description = described(step, time);
    enter();
    const bool wanted = script_->RequestDataDescription(description) != 0;
    // A script that raises here is executed, so that its error is reported.
    pending_ = ranks_.agree(error_now());
    if (!pending_.empty()) return is_.channels;
    std::uint32_t mask = 0;
    for (int channel = 0; wanted && channel < BRECCIA_NUM_CHANNELS; ++channel) {
      vtkCPInputDataDescription* input =
          description->GetInputDescriptionByName(kChannelNames[static_cast<std::size_t>(channel)]);
      // Before its first execution the script has not been imported and marks nothing.
      if (input != nullptr && (!executed_ || input->GetIfGridIsNecessary())) mask |= bit(channel);
    }
    return mask;
  }

  void execute(const Frame& frame, BrecciaRequests& requests) override {
    if (!pending_.empty()) throw PipelineError(std::exchange(pending_, {}));
    if (const std::string why = ranks_.agree(reason_to_end()); !why.empty()) {
      dropped_ = true;
      throw PipelineError(why);
    }
    ranks_.throw_agreed(no_space());
    const ScriptWatch::Turn turn(watch_, "pipeline " + is_.name);
    const auto description = described(frame.step, frame.time);
    UserData user_data;
    description->SetUserData(user_data.data());
    for (int channel = 0; channel < BRECCIA_NUM_CHANNELS; ++channel) {
      const auto index = static_cast<std::size_t>(channel);
      if ((is_.channels & bit(channel)) == 0) continue;
      vtkCPInputDataDescription* input = description->GetInputDescriptionByName(kChannelNames[index]);
      input->AllFieldsOn();
      input->GenerateMeshOn();
      input->SetGrid(frame.channels[index]);
    }
    enter();
    executed_ = true;
    script_->CoProcess(description);  // its result is also 0 when a trigger of the script is not met
    empty_producers();
    const std::string error = error_now();
    // ParaView would execute what it could not initialize, and read memory that it does not have.
    dropped_ = dropped_ || watch_.interrupted() || !python::usable();
    if (!error.empty()) throw PipelineError(error);
    user_data.add_to(requests);
  }

  [[nodiscard]] std::int64_t bytes_written() const override {
    return ranks_.is_root() ? bytes_in_folder(is_.folder) - written_before_ : 0;
  }

  [[nodiscard]] bool draws() const override { return true; }

  void finish() override {
    if (is_.display != nullptr && !ranks_.agree(is_.display->lost() ? "lost" : "").empty()) return;
    const ScriptWatch::Turn turn(watch_, "pipeline " + is_.name);
    enter();
    if (!python::usable()) return;
    script_->Finalize();
    end_failure_ = ranks_.agree(error_now());
  }

  [[nodiscard]] std::string notice() override {
    std::string text = agreed_notices(ranks_, python::take_output(is_.folder));
    if (const std::string failure = std::exchange(end_failure_, {}); !failure.empty())
      text += std::string(kWarning) + "at its end: " + failure + '\n';
    return text;
  }

 private:
  void enter() const {
    python::enter(is_.name, is_.file, is_.folder, is_.parameters, is_.about);
    static_cast<void>(take_warnings());  // of others
  }

  /// Reason to end it, on this rank; empty: none.
  [[nodiscard]] std::string reason_to_end() const {
    if (dropped_) return kDropped;
    return is_.display != nullptr && is_.display->lost() ? "the X display on which it draws has closed" : "";
  }

  /// VTK's writers do not bear a full disk well. Empty: there is space.
  [[nodiscard]] std::string no_space() const {
    std::error_code error;
    const auto space = std::filesystem::space(is_.folder, error);
    return error || space.available >= kLeastSpace ? std::string() : is_.folder.string() + ": " + std::strerror(ENOSPC);
  }

  /// What Python raised or VTK reported since the last call. Warnings become output of the script.
  [[nodiscard]] static std::string error_now() {
    const std::string raised = python::take_error();
    const std::string reported = take_errors();
    for (const std::string& warning : take_warnings()) {
      if (!is_of_channels(warning)) python::add_output(warning, python::Output::warning);
    }
    if (!reported.empty()) python::add_output("VTK: " + reported + '\n', python::Output::log);
    return raised.empty() ? reported : raised;
  }

  [[nodiscard]] vtkSmartPointer<vtkCPDataDescription> described(std::int64_t step, double time) const {
    auto description = vtkSmartPointer<vtkCPDataDescription>::New();
    for (int channel = 0; channel < BRECCIA_NUM_CHANNELS; ++channel) {
      if ((is_.channels & bit(channel)) != 0) description->AddInput(kChannelNames[static_cast<std::size_t>(channel)]);
    }
    description->SetTimeData(time, step);
    return description;
  }

  static constexpr const char* kDropped = "dropped";
  static constexpr std::uintmax_t kLeastSpace = 1 << 20;  ///< bytes

  const Ranks& ranks_;
  ScriptWatch& watch_;
  ScriptDescription is_;
  vtkNew<vtkCPPythonScriptV2Pipeline> script_;
  bool executed_ = false;
  bool dropped_ = false;  ///< it has taken too long, or cannot draw any more
  std::string pending_;   ///< exception of the script at the query of its channels
  std::string end_failure_;
  std::int64_t written_before_ = 0;
};

}  // namespace

struct CatalystBackend::Session {
  std::unique_ptr<OwnMpi> mpi;  // first: ended last
  vtkNew<vtkCPProcessor> processor;
};

CatalystBackend::CatalystBackend(const Ranks& ranks)
    : ranks_(ranks), watch_(0.5 * ranks.patience()), session_(std::make_unique<Session>()) {
  static bool begun = false;
  if (std::exchange(begun, true))
    throw PipelineError("ParaView has been started in this process before; it cannot be started twice");
  MPI_Comm communicator = ranks.communicator();
  if (communicator == MPI_COMM_NULL) {
    if (!OwnMpi::is_started()) session_->mpi = std::make_unique<OwnMpi>();
    communicator = MPI_COMM_SELF;
  }
  vtkMPICommunicatorOpaqueComm wrapped(&communicator);
  const bool started = session_->processor->Initialize(wrapped) != 0;
  capture_messages();
  if (!started) throw PipelineError("ParaView cannot be started");
}

CatalystBackend::~CatalystBackend() {
  session_->processor->Finalize();
  static_cast<void>(take_errors());
}

std::unique_ptr<Pipeline> CatalystBackend::script(ScriptDescription description) {
  python::start(data_folder() / "pipelines", data_folder() / "python", ranks_, watch_);
  return std::make_unique<ScriptPipeline>(ranks_, watch_, std::move(description));
}

const char* backend_description() {
  static const std::string text = std::string("ParaView Catalyst ") + PARAVIEW_VERSION_FULL;
  return text.c_str();
}

}  // namespace breccia::insitu
