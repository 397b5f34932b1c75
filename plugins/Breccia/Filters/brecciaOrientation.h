#ifndef brecciaOrientation_h
#define brecciaOrientation_h

#include "brecciaJoints.h"

namespace breccia {

/// How a plane lies, degrees. Strike is 90 less than the dip direction, modulo 180; azimuths run from north over east.
struct Orientation {
  double strike, dip, dip_direction;
  double x, y;  ///< pole in the lower half-space, equal-area projection into the unit circle, x east, y north
};
/// @param normal  unit, of either sense;  @param up  axis, 0 to 2: east and north are the next two
Orientation OrientationOf(const Vector& normal, int up);

/// Where the front of a crack is: the joint furthest from the one that failed first.
struct Tip {
  double time, distance, speed;  ///< s, m, m/s since the last one
  Vector position;
};
/// At every time at which it goes further; the first one is where it all began. O(n log n)
std::vector<Tip> TipsOf(std::vector<FailedJoint> joints);
/// Slope of distance over time by least squares, m/s; NaN with fewer than two times.
double MeanSpeed(const std::vector<Tip>& tips);

/// How far a surface departs from a plane.
struct Roughness {
  double area = 0;            ///< m2
  double projected_area = 0;  ///< m2, on the plane that fits best
  double rms_height = 0;      ///< m, of the triangles' centres above it, weighted by area
};
Roughness RoughnessOf(const std::vector<FailedJoint>& joints);

}  // namespace breccia

#endif
