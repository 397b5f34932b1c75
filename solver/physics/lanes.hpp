#pragma once

// Conditions over number types: bool for T = double, masks for T = std::experimental::simd<double, ...>.

#include <experimental/simd>

#include <type_traits>

namespace breccia::lanes {

template <class T>
struct MaskOf {
  using type = typename T::mask_type;
};
template <>
struct MaskOf<double> {
  using type = bool;
};
template <class T>
using Mask = typename MaskOf<T>::type;

template <class M>
[[nodiscard]] inline bool any(const M& mask) {
  if constexpr (std::is_same_v<M, bool>) {
    return mask;
  } else {
    return std::experimental::any_of(mask);
  }
}
template <class M>
[[nodiscard]] inline bool all(const M& mask) {
  if constexpr (std::is_same_v<M, bool>) {
    return mask;
  } else {
    return std::experimental::all_of(mask);
  }
}

}  // namespace breccia::lanes
