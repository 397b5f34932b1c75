/**
 * @class vtkBrecciaFilter
 * @brief what the filters on Breccia's runs have in common
 *
 * Makes the outputs, calls Make, and turns what that throws into an error of ParaView's.
 */
#ifndef vtkBrecciaFilter_h
#define vtkBrecciaFilter_h

#include <string>  // for names of types
#include <vector>  // for lists of them

#include "BrecciaFiltersModule.h"  // for export macro
#include "vtkDataObjectAlgorithm.h"

class BRECCIAFILTERS_EXPORT vtkBrecciaFilter : public vtkDataObjectAlgorithm {
 public:
  vtkAbstractTypeMacro(vtkBrecciaFilter, vtkDataObjectAlgorithm);

  /// The channel "joints" or "fractures", for where the first input has none (in Catalyst).
  void SetJointsConnection(vtkAlgorithmOutput* joints) { this->SetInputConnection(1, joints); }

 protected:
  /// @param inputs  1, or 2 with an optional second one;  @param outputs  names of their classes
  vtkBrecciaFilter(int inputs, std::vector<std::string> outputs);
  ~vtkBrecciaFilter() override = default;

  /// Fills the outputs. @param joints  null: not given. Throws breccia::BadInput on all ranks or on none.
  virtual void Make(vtkDataObject* input, vtkDataObject* joints, vtkInformationVector* outputs) = 0;

  /// The first input at another time, on all ranks: its own frames are read for that. Former pointers into the input
  /// are invalid; request the shown time at the end, for other filters. Throws breccia::BadInput on all ranks when
  /// there is none. (The pipeline's way, CONTINUE_EXECUTING, never ends when the input fails.)
  vtkDataObject* InputAt(double time);
  /// s, of the first input's frames, ascending; known before the data.
  std::vector<double> Times;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

 private:
  vtkBrecciaFilter(const vtkBrecciaFilter&) = delete;
  void operator=(const vtkBrecciaFilter&) = delete;
  std::vector<std::string> OutputTypes;
};

#endif
