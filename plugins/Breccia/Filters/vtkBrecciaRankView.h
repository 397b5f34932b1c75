/**
 * @class vtkBrecciaRankView
 * @brief who works on what
 *
 * From the elements of a run: a box around the elements of each of the run's ranks, with their number and cost; the
 * same as a table. On the first rank of ParaView. Field data: imbalance, largest over mean cost less 1.
 */
#ifndef vtkBrecciaRankView_h
#define vtkBrecciaRankView_h

#include "vtkBrecciaFilter.h"

class BRECCIAFILTERS_EXPORT vtkBrecciaRankView : public vtkBrecciaFilter {
 public:
  static vtkBrecciaRankView* New();
  vtkTypeMacro(vtkBrecciaRankView, vtkBrecciaFilter);

 protected:
  vtkBrecciaRankView();
  ~vtkBrecciaRankView() override = default;
  void Make(vtkDataObject* input, vtkDataObject* joints, vtkInformationVector* outputs) override;

 private:
  vtkBrecciaRankView(const vtkBrecciaRankView&) = delete;
  void operator=(const vtkBrecciaRankView&) = delete;
};

#endif
