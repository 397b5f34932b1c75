/**
 * @class vtkBrecciaFractureSurface
 * @brief faces of failed joints as surfaces, where they point, and how their tip runs
 *
 * Outputs: the surfaces, one triangle a failed joint, corners that lie together merged, with area, strike, dip and
 * dip_direction beside the joints' own arrays; the rose of strikes, area by mode in bins of ten degrees; the
 * stereonet, poles in the lower half-space in equal-area projection; the crack tip, the furthest joint from the one
 * that failed first, at every time at which it went further. All but the first are on the first rank. Field data of
 * the surfaces: area, roughness.
 */
#ifndef vtkBrecciaFractureSurface_h
#define vtkBrecciaFractureSurface_h

#include "vtkBrecciaFilter.h"

class BRECCIAFILTERS_EXPORT vtkBrecciaFractureSurface : public vtkBrecciaFilter {
 public:
  static vtkBrecciaFractureSurface* New();
  vtkTypeMacro(vtkBrecciaFractureSurface, vtkBrecciaFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Joints that failed in one mode only: 1, 2, 3 (mixed); 0: all.
  vtkSetClampMacro(Mode, int, 0, 3);
  vtkGetMacro(Mode, int);
  ///@}
  ///@{
  /// Axis that points up, 0 to 2; east and north are the two after it.
  vtkSetClampMacro(Up, int, 0, 2);
  vtkGetMacro(Up, int);
  ///@}

 protected:
  vtkBrecciaFractureSurface();
  ~vtkBrecciaFractureSurface() override = default;
  void Make(vtkDataObject* input, vtkDataObject* joints, vtkInformationVector* outputs) override;

  int Mode = 0;
  int Up = 2;

 private:
  vtkBrecciaFractureSurface(const vtkBrecciaFractureSurface&) = delete;
  void operator=(const vtkBrecciaFractureSurface&) = delete;
};

#endif
