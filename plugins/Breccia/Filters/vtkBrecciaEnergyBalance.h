/**
 * @class vtkBrecciaEnergyBalance
 * @brief where the energy of a run is, over time
 *
 * From the history of a run (the reader's second output): a table with the time, every term of the budget that is not
 * always 0, the same terms stacked ("up to ...", each the sum of those before it: fill between them for a stacked
 * plot), and the residual's share.
 */
#ifndef vtkBrecciaEnergyBalance_h
#define vtkBrecciaEnergyBalance_h

#include "vtkBrecciaFilter.h"

class BRECCIAFILTERS_EXPORT vtkBrecciaEnergyBalance : public vtkBrecciaFilter {
 public:
  static vtkBrecciaEnergyBalance* New();
  vtkTypeMacro(vtkBrecciaEnergyBalance, vtkBrecciaFilter);

 protected:
  vtkBrecciaEnergyBalance();
  ~vtkBrecciaEnergyBalance() override = default;
  void Make(vtkDataObject* input, vtkDataObject* joints, vtkInformationVector* outputs) override;

 private:
  vtkBrecciaEnergyBalance(const vtkBrecciaEnergyBalance&) = delete;
  void operator=(const vtkBrecciaEnergyBalance&) = delete;
};

#endif
