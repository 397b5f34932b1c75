#include "peers.hpp"

#include <cstdio>

namespace breccia::lab {

void add_peers([[maybe_unused]] Contenders& searches, [[maybe_unused]] PointContenders& point_searches) {
#ifdef BRECCIA_PEER_CGAL
  add_cgal(searches, point_searches);
#else
  std::puts("skipped: CGAL (./run detection builds it in and installs libcgal-dev)");
#endif
#ifdef BRECCIA_PEER_BOOST
  add_boost(searches, point_searches);
#else
  std::puts("skipped: Boost.Geometry (./run detection builds it in and installs libboost-dev)");
#endif
#ifdef BRECCIA_PEER_EMBREE
  add_embree(searches, point_searches);
#else
  std::puts("skipped: Embree (./run detection builds it in and installs libembree-dev)");
#endif
#ifdef BRECCIA_PEER_NANOFLANN
  add_nanoflann(searches, point_searches);
#else
  std::puts("skipped: nanoflann (./run detection builds it in and installs libnanoflann-dev)");
#endif
#ifdef BRECCIA_PEER_BULLET
  add_bullet(searches, point_searches);
#else
  std::puts("skipped: Bullet (./run detection builds it in and installs libbullet-dev)");
#endif
}

std::vector<detection::CoupleTest> couple_tests(const std::vector<detection::Corners>& contactors, double buffer) {
  std::vector<detection::CoupleTest> tests;
  tests.reserve(contactors.size());
  for (const detection::Corners& corners : contactors) tests.emplace_back(corners, buffer);
  return tests;
}

}  // namespace breccia::lab
