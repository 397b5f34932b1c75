#include "vtkBrecciaReader.h"

#include <algorithm>
#include <cstdlib>

#include "brecciaBodies.h"
#include "brecciaData.h"
#include "brecciaRunFolder.h"
#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArraySelection.h"
#include "vtkExecutive.h"
#include "vtkHDFReader.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

vtkStandardNewMacro(vtkBrecciaReader);

namespace {

/// Keeps what a reader complains of.
void Remember(vtkObject*, unsigned long, void* list, void* text) {
  auto& complaints = *static_cast<std::string*>(list);
  if (complaints.empty()) complaints = static_cast<const char*>(text);
  while (!complaints.empty() && (complaints.back() == '\n' || complaints.back() == ' ')) complaints.pop_back();
}

}  // namespace

vtkBrecciaReader::vtkBrecciaReader() {
  setenv("HDF5_USE_FILE_LOCKING", "FALSE", 0);  // frames are written once; a file system may have no locks
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(2);
  this->ChannelSelection->AddObserver(vtkCommand::ModifiedEvent, this, &vtkBrecciaReader::Modified);
}

vtkBrecciaReader::~vtkBrecciaReader() { this->SetFileName(nullptr); }

vtkDataArraySelection* vtkBrecciaReader::GetChannelSelection() { return this->ChannelSelection; }

int vtkBrecciaReader::CanReadFile(const char* name) { return name && breccia::IsRun(name) ? 1 : 0; }

int vtkBrecciaReader::FillOutputPortInformation(int port, vtkInformation* info) {
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkMultiBlockDataSet" : "vtkTable");
  return 1;
}

int vtkBrecciaReader::RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) {
  if (!vtkMultiBlockDataSet::GetData(outputs, 0)) {
    vtkNew<vtkMultiBlockDataSet> blocks;
    outputs->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), blocks);
  }
  if (!vtkTable::GetData(outputs, 1)) {
    vtkNew<vtkTable> table;
    outputs->GetInformationObject(1)->Set(vtkDataObject::DATA_OBJECT(), table);
  }
  return 1;
}

int vtkBrecciaReader::RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) {
  if (!this->FileName || !*this->FileName) {
    vtkErrorMacro("no file name: give the folder of a run, or its status.jsonl");
    return 0;
  }
  try {
    const breccia::RunFolder run = breccia::OpenRun(this->FileName);
    for (const std::string& file : run.incomplete) vtkWarningMacro(<< file << " is missing or cut off; it is left out");
    for (const breccia::RecordedChannel& channel : run.channels) {
      if (!this->ChannelSelection->ArrayExists(channel.name.c_str()))
        this->ChannelSelection->AddArray(channel.name.c_str());
    }
    const std::vector<double> times = run.Times();
    const double range[2] = {times.front(), times.back()};
    for (int port = 0; port < 2; ++port) outputs->GetInformationObject(port)->Set(CAN_HANDLE_PIECE_REQUEST(), 1);
    vtkInformation* info = outputs->GetInformationObject(0);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    return 1;
  } catch (const breccia::BadInput& bad) {
    vtkErrorMacro(<< bad.what());
    return 0;
  }
}

int vtkBrecciaReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) {
  vtkInformation* info = outputs->GetInformationObject(0);
  const auto asked = [&](vtkInformationIntegerKey* key, int otherwise) {
    return info->Has(key) ? info->Get(key) : otherwise;
  };
  const int piece = asked(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
  const int pieces = asked(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  try {
    const breccia::RunFolder run = breccia::OpenRun(this->FileName ? this->FileName : "");
    double time = run.Times().front();
    for (const int port : {1, 0}) {  // a request for the history alone is followed by one for the run of that time
      vtkInformation* asking = outputs->GetInformationObject(port);
      if (asking->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
        time = asking->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
    }
    auto* blocks = vtkMultiBlockDataSet::GetData(outputs, 0);
    blocks->Initialize();
    unsigned int block = 0;
    for (const breccia::RecordedChannel& channel : run.channels) {
      if (!this->ChannelSelection->ArrayIsEnabled(channel.name.c_str())) continue;
      blocks->SetBlock(block, this->ReadFrame(channel.name, channel.At(time).path, piece, pieces));
      blocks->GetMetaData(block)->Set(vtkCompositeDataSet::NAME(), channel.name.c_str());
      if (channel.name == "elements") breccia::AddBodyNames(blocks->GetBlock(block), breccia::ReadBodyNames(run.path));
      ++block;
    }
    blocks->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    if (piece == 0) {
      auto* table = vtkTable::GetData(outputs, 1);
      table->Initialize();
      const breccia::run_folder::History history = breccia::ReadHistory(run.path);
      for (std::size_t i = 0; i < history.names.size(); ++i)
        breccia::AddColumn(table, history.names[i].c_str(), history.columns[i]);
    }
    return 1;
  } catch (const breccia::BadInput& bad) {
    vtkErrorMacro(<< bad.what());
    return 0;
  }
}

vtkSmartPointer<vtkUnstructuredGrid> vtkBrecciaReader::ReadFrame(const std::string& channel, const std::string& path,
                                                                 int piece, int pieces) {
  vtkSmartPointer<vtkHDFReader>& reader = this->Readers[channel];
  if (!reader) reader = vtkSmartPointer<vtkHDFReader>::New();
  std::string complaint;
  vtkNew<vtkCallbackCommand> remember;
  remember->SetCallback(Remember);
  remember->SetClientData(&complaint);
  const unsigned long observer = reader->AddObserver(vtkCommand::ErrorEvent, remember);
  const unsigned long inner = reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, remember);
  reader->SetFileName(path.c_str());
  const bool known = reader->CanReadFile(path.c_str()) != 0;
  const bool read = known && reader->UpdatePiece(piece, pieces, 0) != 0;
  reader->RemoveObserver(observer);
  reader->GetExecutive()->RemoveObserver(inner);
  auto* grid = vtkUnstructuredGrid::SafeDownCast(reader->GetOutputDataObject(0));
  if (!read || !complaint.empty() || !grid)
    throw breccia::BadInput(path + " is no frame of Breccia that can be read" +
                            (complaint.empty() ? "" : ": " + complaint));
  auto copy = vtkSmartPointer<vtkUnstructuredGrid>::New();
  copy->ShallowCopy(grid);
  if (channel == "elements") copy->GetCellData()->SetActiveScalars("von_mises");
  return copy;
}

void vtkBrecciaReader::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
