#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace breccia {

/// Allocator of 64-byte aligned storage: a block of eight doubles is one cache line.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};

  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) noexcept {}

  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) noexcept { ::operator delete(p, alignment); }
  template <class U>
  bool operator==(const CacheLineAllocator<U>&) const noexcept {
    return true;
  }
};

/// Contiguous, cache-line aligned array: the storage of everything a kernel reads or writes.
/// Views of it are std::span.
template <class T>
using Field = std::vector<T, CacheLineAllocator<T>>;

}  // namespace breccia
