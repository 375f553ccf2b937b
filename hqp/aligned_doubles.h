// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace poise {

/// Allocates memory that begins at a cache line. If the rows of a matrix are a
/// multiple of four doubles apart, none of their vectors of four doubles then
/// lies in two lines, which would take longer to load.
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

/// Matrices and vectors of the inner loops of the solver.
using AlignedDoubles = std::vector<double, CacheLineAllocator<double>>;

}  // namespace poise
