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
  ~vtkBrecciaRankView() override = default;
  void Make(vtkDataObject* input, vtkDataObject* joints, vtkInformationVector* outputs) override;

 private:
  vtkBrecciaRankView(const vtkBrecciaRankView&) = delete;
  void operator=(const vtkBrecciaRankView&) = delete;

  bool OverTime = false;
};

#endif
