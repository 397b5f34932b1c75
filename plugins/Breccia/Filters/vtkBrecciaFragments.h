/**
 * @class vtkBrecciaFragments
 * @brief connected parts of broken bodies
 *
 * Finds the connected parts of a Breccia run's elements through joints that have not failed, across
 * pieces and ranks, and computes mass, shape and motion of each. Outputs: the elements, with the arrays fragment,
 * fragment_mass, fragment_diameter and fragment_speed; the table of fragments; the sieve curve with fits in its columns
 * and d50, d80 and the fits' parameters in its field data. Tables are on the first rank. Ids and tables are the same,
 * to the last bit, on any number of ranks.
 *
 * The first input is a run as vtkBrecciaReader gives it, or the channel "elements"; the second, optional one is the
 * channel "joints" or "fractures", for where the first one has no joints (in Catalyst).
 */
#ifndef vtkBrecciaFragments_h
#define vtkBrecciaFragments_h

#include <vector>  // for FollowedElements

#include "BrecciaFiltersModule.h"  // for export macro
#include "vtkBrecciaFilter.h"

class BRECCIAFILTERS_EXPORT vtkBrecciaFragments : public vtkBrecciaFilter {
 public:
  static vtkBrecciaFragments* New();
  vtkTypeMacro(vtkBrecciaFragments, vtkBrecciaFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum SieveMeasures { MIDDLE_AXIS = 0, SPHERE = 1 };
  ///@{
  /// Size of a fragment on a sieve: middle diameter of its ellipsoid, or diameter of the sphere of its volume.
  vtkSetClampMacro(SieveMeasure, int, MIDDLE_AXIS, SPHERE);
  vtkGetMacro(SieveMeasure, int);
  ///@}

  ///@{
  /// Leave parts that no crack bounds (projectiles, supports, a body before it breaks) out of the sieve curve.
  vtkSetMacro(OnlyBroken, bool);
  vtkGetMacro(OnlyBroken, bool);
  ///@}

  ///@{
  /// Show only the fragments that hold these elements, now: a fragment followed through time. None: all.
  void AddFollowedElement(vtkIdType id);
  void ClearFollowedElements();
  ///@}

 protected:
  vtkBrecciaFragments();
  ~vtkBrecciaFragments() override = default;

  void Make(vtkDataObject* input, vtkDataObject* joints, vtkInformationVector* outputs) override;

  int SieveMeasure = MIDDLE_AXIS;
  bool OnlyBroken = true;
  std::vector<vtkIdType> FollowedElements;

 private:
  vtkBrecciaFragments(const vtkBrecciaFragments&) = delete;
  void operator=(const vtkBrecciaFragments&) = delete;
};

#endif
