#include "peers.hpp"

#include <cstdio>

namespace breccia::lab {

void add_peers(Contenders& searches, PointContenders& point_searches) {
#ifdef BRECCIA_PEER_CGAL
  add_cgal(searches, point_searches);
#else
  std::puts("skipped: CGAL (libcgal-dev is not installed)");
#endif
#ifdef BRECCIA_PEER_BOOST
  add_boost(searches, point_searches);
#else
  std::puts("skipped: Boost.Geometry (libboost-dev is not installed)");
#endif
#ifdef BRECCIA_PEER_EMBREE
  add_embree(searches, point_searches);
#else
  std::puts("skipped: Embree (libembree-dev is not installed)");
#endif
#ifdef BRECCIA_PEER_NANOFLANN
  add_nanoflann(searches, point_searches);
#else
  std::puts("skipped: nanoflann (libnanoflann-dev is not installed)");
#endif
#ifdef BRECCIA_PEER_BULLET
  add_bullet(searches, point_searches);
#else
  std::puts("skipped: Bullet (libbullet-dev is not installed)");
#endif
}

std::vector<detection::CoupleTest> couple_tests(const std::vector<detection::Corners>& contactors, double buffer) {
  std::vector<detection::CoupleTest> tests;
  tests.reserve(contactors.size());
  for (const detection::Corners& corners : contactors) tests.emplace_back(corners, buffer);
  return tests;
}

}  // namespace breccia::lab
