#include <immintrin.h>

#include <cstddef>

#include "detection/point_body/packed_tree_walk.hpp"

namespace breccia::detection {

const SetBits set_bits = make_set_bits();

namespace {

/// Four floats or two doubles at a time: what every x86-64 processor has.
struct Sse2 {
  class Box {
   public:
    explicit Box(const PackedQuery& query) {
      for (int axis = 0; axis < 3; ++axis) {
        low_[axis] = _mm_set1_ps(query.low[axis]);
        high_[axis] = _mm_set1_ps(query.high[axis]);
      }
    }
    unsigned meets(const float* group) const { return four(group) | four(group + 4) << 4; }

   private:
    unsigned four(const float* group) const {
      const __m128 x = overlap(group, 0), y = overlap(group, 1), z = overlap(group, 2);
      return static_cast<unsigned>(_mm_movemask_ps(_mm_and_ps(_mm_and_ps(x, y), z)));
    }
    __m128 overlap(const float* group, std::size_t axis) const {
      return _mm_and_ps(_mm_cmple_ps(_mm_loadu_ps(group + 8 * axis), high_[axis]),
                        _mm_cmpge_ps(_mm_loadu_ps(group + 24 + 8 * axis), low_[axis]));
    }
    __m128 low_[3], high_[3];
  };

  class Body {
   public:
    explicit Body(const PackedQuery& query) : query_(query) {}
    unsigned holds(const double* leaf) const {
      return two(leaf) | two(leaf + 2) << 2 | two(leaf + 4) << 4 | two(leaf + 6) << 6;
    }

   private:
    static __m128d within(__m128d x, double low, double high) {
      return _mm_and_pd(_mm_cmpge_pd(x, _mm_set1_pd(low)), _mm_cmple_pd(x, _mm_set1_pd(high)));
    }
    unsigned two(const double* leaf) const {
      const PackedQuery& q = query_;
      __m128d x = _mm_loadu_pd(leaf), y = _mm_loadu_pd(leaf + 8), z = _mm_loadu_pd(leaf + 16);
      __m128d held =
          _mm_and_pd(_mm_and_pd(within(x, q.box_low[0], q.box_high[0]), within(y, q.box_low[1], q.box_high[1])),
                     within(z, q.box_low[2], q.box_high[2]));
      const auto in_box = static_cast<unsigned>(_mm_movemask_pd(held));
      if (!q.has_planes || in_box == 0) return in_box;
      x = _mm_sub_pd(x, _mm_set1_pd(q.origin[0]));
      y = _mm_sub_pd(y, _mm_set1_pd(q.origin[1]));
      z = _mm_sub_pd(z, _mm_set1_pd(q.origin[2]));
      for (int plane = 0; plane < 4; ++plane) {
        const double* const n = q.normal[plane];
        const __m128d in_xy = _mm_add_pd(_mm_mul_pd(_mm_set1_pd(n[0]), x), _mm_mul_pd(_mm_set1_pd(n[1]), y));
        const __m128d distance = _mm_add_pd(in_xy, _mm_mul_pd(_mm_set1_pd(n[2]), z));
        held = _mm_andnot_pd(_mm_cmpgt_pd(distance, _mm_set1_pd(q.limit[plane])), held);
      }
      return static_cast<unsigned>(_mm_movemask_pd(held));
    }
    const PackedQuery& query_;
  };

  static void number(std::uint32_t first, unsigned mask, std::uint32_t* to) {
    const auto* const bits = reinterpret_cast<const __m128i*>(set_bits.of[mask]);
    const __m128i base = _mm_set1_epi32(static_cast<int>(first));
    auto* const out = reinterpret_cast<__m128i*>(to);
    _mm_storeu_si128(out, _mm_add_epi32(base, _mm_load_si128(bits)));
    _mm_storeu_si128(out + 1, _mm_add_epi32(base, _mm_load_si128(bits + 1)));
  }
  static void choose(const std::int32_t* from, unsigned mask, std::int32_t* to) {
    for (int k = 0; k < 8; ++k) to[k] = from[set_bits.of[mask][k]];
  }
};

}  // namespace

const PackedKernel packed_kernel_sse2{walk_to_leaves<Sse2>, points_of_leaves<Sse2>};

}  // namespace breccia::detection
