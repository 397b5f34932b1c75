/**
 * @class vtkBrecciaCrackEvents
 * @brief failed joints grouped into events, as in acoustic emission
 *
 * Joints of which one is near the other in space and in time belong to one event (single linkage). Outputs, on the
 * first rank: a point for each event, with its arrays; the same as a table; the distribution of magnitudes, with the
 * b-value in its field data.
 *
 * Moment tensor of an event: sum of A (lambda (u . n) I + mu (u n + n u)) over its joints of area A, normal n and
 * displacement jump u [Aki and Richards, Quantitative Seismology, 3.2]. The jump between the two faces, their normal,
 * area and centre are those at the time of failure, between the frames before and after it in proportion to the time
 * (MomentAt: time of failure); of the time shown if so selected, and if the input has one time only; the opening along
 * the normal where elements are not given. Scalar moment M0 = sqrt(M:M / 2); magnitude 2/3 (lg M0 -
 * 9.1) [Hanks and Kanamori 1979, in N m]; energy magnitude 2/3 lg E - 2.9, E in J [Choy and Boatwright 1995]. b-value:
 * lg e / (mean - M_c) over M >= M_c [Aki 1965], M_c where most events are [Wiemer and Wyss 2000] unless given.
 */
#ifndef vtkBrecciaCrackEvents_h
#define vtkBrecciaCrackEvents_h

#include <vector>  // for joints

#include "vtkBrecciaFilter.h"

namespace breccia {
struct FailedJoint;
}

class BRECCIAFILTERS_EXPORT vtkBrecciaCrackEvents : public vtkBrecciaFilter {
 public:
  static vtkBrecciaCrackEvents* New();
  vtkTypeMacro(vtkBrecciaCrackEvents, vtkBrecciaFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// m between centres of joints of one event; 0: twice the square root of the mean area.
  vtkSetMacro(Distance, double);
  vtkGetMacro(Distance, double);
  ///@}
  ///@{
  /// s between failures of joints of one event; 0: what a wave needs for the distance.
  vtkSetMacro(Duration, double);
  vtkGetMacro(Duration, double);
  ///@}
  ///@{
  /// m/s, of that wave.
  vtkSetMacro(WaveSpeed, double);
  vtkGetMacro(WaveSpeed, double);
  ///@}
  ///@{
  /// Pa and 1, for moment tensors.
  vtkSetMacro(YoungsModulus, double);
  vtkGetMacro(YoungsModulus, double);
  vtkSetMacro(PoissonsRatio, double);
  vtkGetMacro(PoissonsRatio, double);
  ///@}
  enum Instants { AT_FAILURE = 0, AT_TIME_SHOWN = 1 };
  ///@{
  /// Of which instant the positions are.
  vtkSetClampMacro(MomentAt, int, AT_FAILURE, AT_TIME_SHOWN);
  vtkGetMacro(MomentAt, int);
  ///@}
  enum Magnitudes { OF_MOMENT = 0, OF_ENERGY = 1 };
  ///@{
  /// Which magnitude the b-value is of. That of the energy needs no property of the material.
  vtkSetClampMacro(MagnitudeOf, int, OF_MOMENT, OF_ENERGY);
  vtkGetMacro(MagnitudeOf, int);
  ///@}
  ///@{
  /// Magnitude from which on events are complete; above 20: found from the data.
  vtkSetMacro(Completeness, double);
  vtkGetMacro(Completeness, double);
  ///@}

 protected:
  vtkBrecciaCrackEvents();
  ~vtkBrecciaCrackEvents() override = default;
  void Make(vtkDataObject* input, vtkDataObject* joints, vtkInformationVector* outputs) override;

  int MomentAt = AT_FAILURE;
  double Distance = 0;
  double Duration = 0;
  double WaveSpeed = 3000;
  double YoungsModulus = 30e9;
  double PoissonsRatio = 0.2;
  int MagnitudeOf = OF_ENERGY;
  double Completeness = 100;

 private:
  vtkBrecciaCrackEvents(const vtkBrecciaCrackEvents&) = delete;
  void operator=(const vtkBrecciaCrackEvents&) = delete;

  /// Sets places and jumps of the joints to those at their time of failure.
  void GoToFailures(std::vector<breccia::FailedJoint>& joints, double shown);
};

#endif
