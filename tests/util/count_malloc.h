// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// Counts the heap allocations of this thread during the object's lifetime, and
/// the bytes that remain allocated.
///
///     CountMalloc count;
///     Control(...);  // No allocation allowed from here ...
///     EXPECT_EQ(count.allocations(), 0);
///
/// Under a sanitizer, which brings its own malloc(), the count stays 0.
class CountMalloc {
 public:
  CountMalloc();
  ~CountMalloc();
  CountMalloc(const CountMalloc&) = delete;
  CountMalloc& operator=(const CountMalloc&) = delete;

  int allocations() const;

  /// Bytes allocated minus bytes freed, with the rounding of the allocator.
  long bytes() const;

  /// Returns whether this build can count allocations.
  static bool IsSupported();
};

}  // namespace poise
