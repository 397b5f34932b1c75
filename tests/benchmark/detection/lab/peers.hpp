#pragma once

#include <vector>

#include "contender.hpp"
#include "detection/point_body/couple_test.hpp"

namespace breccia::lab {

/// Libraries that do the same work, one core each, built and searched anew in every call. Each returns exactly
/// Breccia's set: on equal cells by itself (their boxes are closed unit cubes of whole coordinates, exact below 2^24),
/// on tetrahedra after CoupleTest of each candidate, which lies in the contactor's enlarged box. A library that CMake
/// did not find is skipped with one printed line.
void add_peers(Contenders& searches, PointContenders& point_searches);

void add_cgal(Contenders& searches, PointContenders& point_searches);       ///< box_intersection_d, closed boxes
void add_boost(Contenders& searches, PointContenders& point_searches);      ///< R-tree, packed (bulk loading)
void add_embree(Contenders& searches, PointContenders& point_searches);     ///< rtcCollide of user geometry
void add_nanoflann(Contenders& searches, PointContenders& point_searches);  ///< k-d tree, balls
void add_bullet(Contenders& searches, PointContenders& point_searches);     ///< btDbvt, the tree of the broad phase

/// The test of each contactor, made once for all its candidates.
std::vector<detection::CoupleTest> couple_tests(const std::vector<detection::Corners>& contactors, double buffer);

}  // namespace breccia::lab
