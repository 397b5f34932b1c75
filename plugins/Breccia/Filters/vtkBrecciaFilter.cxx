#include "vtkBrecciaFilter.h"

#include <sstream>

#include "brecciaData.h"
#include "vtkAlgorithmOutput.h"
#include "vtkDataObjectTypes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

vtkBrecciaFilter::vtkBrecciaFilter(int inputs, std::vector<std::string> outputs) : OutputTypes(std::move(outputs)) {
  this->SetNumberOfInputPorts(inputs);
  this->SetNumberOfOutputPorts(static_cast<int>(this->OutputTypes.size()));
}

int vtkBrecciaFilter::FillInputPortInformation(int port, vtkInformation* info) {
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  if (port == 1) info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkBrecciaFilter::FillOutputPortInformation(int port, vtkInformation* info) {
  info->Set(vtkDataObject::DATA_TYPE_NAME(), this->OutputTypes[static_cast<std::size_t>(port)].c_str());
  return 1;
}

int vtkBrecciaFilter::RequestInformation(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*) {
  vtkInformation* info = inputs[0]->GetInformationObject(0);
  vtkInformationDoubleVectorKey* key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
  this->Times.clear();
  if (info->Has(key)) this->Times.assign(info->Get(key), info->Get(key) + info->Length(key));
  return 1;
}

vtkDataObject* vtkBrecciaFilter::InputAt(double time) {
  vtkAlgorithmOutput* from = this->GetInputConnection(0, 0);
  auto* pipeline = vtkStreamingDemandDrivenPipeline::SafeDownCast(from->GetProducer()->GetExecutive());
  vtkInformation* info = pipeline ? pipeline->GetOutputInformation(from->GetIndex()) : nullptr;
  if (info) info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), time);
  const bool read = info && pipeline->Update(from->GetIndex()) != 0;
  std::ostringstream problem;
  if (!read) problem << "the input cannot be read at " << time << " s";
  breccia::Ranks().Agree(problem.str());
  return this->GetInputDataObject(0, 0);
}

int vtkBrecciaFilter::RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) {
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port) {
    const char* type = this->OutputTypes[static_cast<std::size_t>(port)].c_str();
    vtkDataObject* now = vtkDataObject::GetData(outputs, port);
    if (now && now->IsA(type)) continue;
    const auto made = vtkSmartPointer<vtkDataObject>::Take(vtkDataObjectTypes::NewDataObject(type));
    outputs->GetInformationObject(port)->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  return 1;
}

int vtkBrecciaFilter::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) {
  try {
    vtkDataObject* joints = this->GetNumberOfInputPorts() > 1 ? vtkDataObject::GetData(inputs[1], 0) : nullptr;
    this->Make(vtkDataObject::GetData(inputs[0], 0), joints, outputs);
    return 1;
  } catch (const breccia::BadInput& bad) {
    vtkErrorMacro(<< bad.what());
    return 0;
  }
}
