/**
 * @class vtkBrecciaContactNetwork
 * @brief which fragments press on which, and how much
 *
 * Contact forces are summed between each two fragments; a body that has not broken is one. Outputs, on the first rank:
 * force chains, tubes from centroid to centroid, as thick as the force; a row for each fragment that touches:
 * coordination number (fragments it touches), the sum of the forces on it and their largest; a row for each two
 * bodies, with the force on the first: forces on walls.
 */
#ifndef vtkBrecciaContactNetwork_h
#define vtkBrecciaContactNetwork_h

#include "vtkBrecciaFilter.h"

class BRECCIAFILTERS_EXPORT vtkBrecciaContactNetwork : public vtkBrecciaFilter {
 public:
  static vtkBrecciaContactNetwork* New();
  vtkTypeMacro(vtkBrecciaContactNetwork, vtkBrecciaFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// m, of the tube of the largest force; 0: a fiftieth of the diagonal around the centroids.
  vtkSetMacro(LargestRadius, double);
  vtkGetMacro(LargestRadius, double);
  ///@}

 protected:
  vtkBrecciaContactNetwork();
  ~vtkBrecciaContactNetwork() override = default;
  void Make(vtkDataObject* input, vtkDataObject* joints, vtkInformationVector* outputs) override;

  double LargestRadius = 0;

 private:
  vtkBrecciaContactNetwork(const vtkBrecciaContactNetwork&) = delete;
  void operator=(const vtkBrecciaContactNetwork&) = delete;
};

#endif
