/**
 * @class vtkBrecciaReader
 * @brief opens the folder of a Breccia run, one that is still running as well
 *
 * Outputs: a block for each recorded channel (elements, joints, contacts); the history as a table, on the first
 * rank. Times are those of all channels; each shows its last frame not after the requested time. Frames that are not
 * whole yet are left out. A file with a piece for each rank of the run is read by as many ranks as there are.
 */
#ifndef vtkBrecciaReader_h
#define vtkBrecciaReader_h

#include <map>     // for readers by channel
#include <string>  // for their names

#include "BrecciaFiltersModule.h"  // for export macro
#include "vtkDataObjectAlgorithm.h"
#include "vtkNew.h"           // for ChannelSelection
#include "vtkSmartPointer.h"  // for readers

class vtkDataArraySelection;
class vtkHDFReader;
class vtkUnstructuredGrid;

class BRECCIAFILTERS_EXPORT vtkBrecciaReader : public vtkDataObjectAlgorithm {
 public:
  static vtkBrecciaReader* New();
  vtkTypeMacro(vtkBrecciaReader, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The run's folder, or any file in it: status.jsonl, which is there from the first step on.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /// Whether the file is one of a run.
  int CanReadFile(VTK_FILEPATH const char* name);
  /// Searches for new frames.
  void Refresh() { this->Modified(); }
  /// Which channels are read.
  vtkDataArraySelection* GetChannelSelection();

 protected:
  vtkBrecciaReader();
  ~vtkBrecciaReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  char* FileName = nullptr;

 private:
  vtkBrecciaReader(const vtkBrecciaReader&) = delete;
  void operator=(const vtkBrecciaReader&) = delete;
  vtkSmartPointer<vtkUnstructuredGrid> ReadFrame(const std::string& channel, const std::string& path, int piece,
                                                 int pieces);

  vtkNew<vtkDataArraySelection> ChannelSelection;
  std::map<std::string, vtkSmartPointer<vtkHDFReader>> Readers;
};

#endif
