/**
 * @class vtkBrecciaRankView
 * @brief who works on what
 *
 * From the elements of a run: a box around the elements of each of the run's ranks, with their number and cost; the
 * same as a table; and, with OverTime on, a line for each frame of the run: the imbalance, and for each rank its load
 * (cost over the mean) and elements. On the first rank of ParaView. Field data of the tables: imbalance, largest over
 * mean cost less 1; of the last one the largest of all frames.
 */
#ifndef vtkBrecciaRankView_h
#define vtkBrecciaRankView_h

#include <memory>  // for what is kept between executions
#include <vector>  // for times

#include "vtkBrecciaFilter.h"

class BRECCIAFILTERS_EXPORT vtkBrecciaRankView : public vtkBrecciaFilter {
 public:
  static vtkBrecciaRankView* New();
  vtkTypeMacro(vtkBrecciaRankView, vtkBrecciaFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Whether all frames are read, for the third output; without it that has a line for the time shown.
  vtkSetMacro(OverTime, bool);
  vtkGetMacro(OverTime, bool);
  vtkBooleanMacro(OverTime, bool);
  ///@}

 protected:
  vtkBrecciaRankView();
  ~vtkBrecciaRankView() override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  void Make(vtkDataObject* input, vtkDataObject* joints, vtkInformationVector* outputs) override;

 private:
  vtkBrecciaRankView(const vtkBrecciaRankView&) = delete;
  void operator=(const vtkBrecciaRankView&) = delete;

  /// What is kept while frames are read, one in each execution of the pipeline.
  struct Walk;
  std::unique_ptr<Walk> Frames;
  std::vector<double> Times;  ///< s, of the input's frames, ascending
  bool OverTime = false;
};

#endif
