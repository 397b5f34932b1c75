#ifndef brecciaEvents_h
#define brecciaEvents_h

#include "brecciaJoints.h"

namespace breccia {

/// Joints that failed together.
struct CrackEvent {
  vtkTypeInt64 id = 0, joints = 0;  ///< smallest id of its joints
  double time = 0, duration = 0;    ///< s, first failure; until the last
  double area = 0, energy = 0;      ///< m2, J
  Vector centre{};                  ///< m, weighted by area
  std::array<double, 6> moment{};   ///< N m, xx yy zz xy yz xz
  double ScalarMoment() const;
  double Magnitude() const;        ///< of the moment; -infinity without one
  double EnergyMagnitude() const;  ///< of the energy
  /// Shares of the moment tensor that are isotropic (negative: implosion), a double couple and a compensated linear
  /// vector dipole; the absolute values add up to 1 [Jost and Herrmann 1989].
  Vector Parts() const;
};

/// @param joints    ascending by id;  @param distance, duration  as in vtkBrecciaCrackEvents, > 0
/// @param lame_1, lame_2  Pa, lambda and mu.  Events ascending by id. O(joints and their near neighbours)
std::vector<CrackEvent> EventsOf(const std::vector<FailedJoint>& joints, double distance, double duration,
                                 double lame_1, double lame_2);

struct MagnitudeFit {
  double b = 0, error = 0, completeness = 0, a = 0;  ///< lg N(>= M) = a - b M
  vtkTypeInt64 events = 0;                           ///< of magnitude M_c or more
};
constexpr double kMagnitudeBin = 0.1;
/// @param completeness  above 20: the lower end of the fullest bin of 0.1
MagnitudeFit FitMagnitudes(const std::vector<double>& magnitudes, double completeness);

}  // namespace breccia

#endif
