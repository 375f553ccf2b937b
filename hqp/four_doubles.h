// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

// Four doubles for kernels, in the vector types of GCC and Clang. The functions
// are inlined, so that they are compiled for the processor of their caller.

// Before kernels: GCC does not vectorise the loops over the entries after the
// last whole four. They are too short: a solve would take 4 % longer.
#if defined(__GNUC__) && !defined(__clang__)
#define POISE_NO_OTHER_VECTORS _Pragma("GCC optimize(\"no-tree-vectorize\")")
#else
#define POISE_NO_OTHER_VECTORS
#endif

#define POISE_INLINE inline __attribute__((always_inline))

namespace poise {

/// Four doubles, aligned as single doubles.
typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));

}  // namespace poise

// These are macros, because a function that returns a vector of this size is
// called in another way with AVX than without it.
#define POISE_LOAD(pointer) (*reinterpret_cast<const ::poise::Four*>(pointer))
#define POISE_STORE(pointer) (*reinterpret_cast<::poise::Four*>(pointer))
#define POISE_SUM(four) (((four)[0] + (four)[2]) + ((four)[1] + (four)[3]))
