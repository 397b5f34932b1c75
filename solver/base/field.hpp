#pragma once

#include <sys/mman.h>
#include <cstddef>
#include <new>
#include <vector>

namespace breccia {

/// Allocator of 64-byte aligned storage: a block of eight doubles is one cache line. Large arrays request huge pages,
/// since the sweep reads ten of them at once and jumps to neighbours, beyond the capacity of the processor's table of
/// small pages; smaller arrays do not, as the unused part of a huge page is lost.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};
  static constexpr std::size_t huge_page = std::size_t{1} << 21;

  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) noexcept {}

  T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    void* const storage = ::operator new(bytes, alignment_of(bytes));
    if (is_large(bytes)) (void)madvise(storage, bytes, MADV_HUGEPAGE);  // a wish: without it everything works
    return static_cast<T*>(storage);
  }
  void deallocate(T* p, std::size_t n) noexcept { ::operator delete(p, alignment_of(n * sizeof(T))); }
  template <class U>
  bool operator==(const CacheLineAllocator<U>&) const noexcept {
    return true;
  }

 private:
  static constexpr bool is_large(std::size_t bytes) { return bytes >= 8 * huge_page; }
  static constexpr std::align_val_t alignment_of(std::size_t bytes) {
    return is_large(bytes) ? std::align_val_t{huge_page} : alignment;
  }
};

/// Contiguous, cache-line aligned array: the storage of everything a kernel reads or writes.
/// Views of it are std::span.
template <class T>
using Field = std::vector<T, CacheLineAllocator<T>>;

}  // namespace breccia
