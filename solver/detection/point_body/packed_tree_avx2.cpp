#include <immintrin.h>

#include <cstddef>

#include "detection/point_body/packed_tree_walk.hpp"

namespace breccia::detection {
namespace {

/// Eight floats or twice four doubles at a time.
struct Avx2 {
  class Box {
   public:
    explicit Box(const PackedQuery& query) {
      for (int axis = 0; axis < 3; ++axis) {
        low_[axis] = _mm256_set1_ps(query.low[axis]);
        high_[axis] = _mm256_set1_ps(query.high[axis]);
      }
    }
    unsigned meets(const float* group) const {
      const __m256 x = overlap(group, 0), y = overlap(group, 1), z = overlap(group, 2);
      return static_cast<unsigned>(_mm256_movemask_ps(_mm256_and_ps(_mm256_and_ps(x, y), z)));
    }

   private:
    __m256 overlap(const float* group, std::size_t axis) const {
      return _mm256_and_ps(_mm256_cmp_ps(_mm256_loadu_ps(group + 8 * axis), high_[axis], _CMP_LE_OQ),
                           _mm256_cmp_ps(_mm256_loadu_ps(group + 24 + 8 * axis), low_[axis], _CMP_GE_OQ));
    }
    __m256 low_[3], high_[3];
  };

  class Body {
   public:
    explicit Body(const PackedQuery& query) : query_(query) {}
    unsigned holds(const double* leaf) const { return four(leaf) | four(leaf + 4) << 4; }

   private:
    static __m256d within(__m256d x, double low, double high) {
      return _mm256_and_pd(_mm256_cmp_pd(x, _mm256_set1_pd(low), _CMP_GE_OQ),
                           _mm256_cmp_pd(x, _mm256_set1_pd(high), _CMP_LE_OQ));
    }
    unsigned four(const double* leaf) const {
      const PackedQuery& q = query_;
      __m256d x = _mm256_loadu_pd(leaf), y = _mm256_loadu_pd(leaf + 8), z = _mm256_loadu_pd(leaf + 16);
      __m256d held =
          _mm256_and_pd(_mm256_and_pd(within(x, q.box_low[0], q.box_high[0]), within(y, q.box_low[1], q.box_high[1])),
                        within(z, q.box_low[2], q.box_high[2]));
      if (!q.has_planes || _mm256_testz_pd(held, held) != 0) return static_cast<unsigned>(_mm256_movemask_pd(held));
      x = _mm256_sub_pd(x, _mm256_set1_pd(q.origin[0]));
      y = _mm256_sub_pd(y, _mm256_set1_pd(q.origin[1]));
      z = _mm256_sub_pd(z, _mm256_set1_pd(q.origin[2]));
      for (int plane = 0; plane < 4; ++plane) {
        const double* const n = q.normal[plane];
        const __m256d in_xy =
            _mm256_add_pd(_mm256_mul_pd(_mm256_set1_pd(n[0]), x), _mm256_mul_pd(_mm256_set1_pd(n[1]), y));
        const __m256d distance = _mm256_add_pd(in_xy, _mm256_mul_pd(_mm256_set1_pd(n[2]), z));
        held = _mm256_andnot_pd(_mm256_cmp_pd(distance, _mm256_set1_pd(q.limit[plane]), _CMP_GT_OQ), held);
      }
      return static_cast<unsigned>(_mm256_movemask_pd(held));
    }
    const PackedQuery& query_;
  };

  static __m256i bits(unsigned mask) { return _mm256_load_si256(reinterpret_cast<const __m256i*>(set_bits.of[mask])); }
  static void number(std::uint32_t first, unsigned mask, std::uint32_t* to) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                        _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)), bits(mask)));
  }
  static void choose(const std::int32_t* from, unsigned mask, std::int32_t* to) {
    const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_permutevar8x32_epi32(all, bits(mask)));
  }
};

}  // namespace

const PackedKernel packed_kernel_avx2{walk_to_leaves<Avx2>, points_of_leaves<Avx2>};

}  // namespace breccia::detection
