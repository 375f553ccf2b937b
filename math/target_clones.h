// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

/// POISE_TARGET_CLONES(target) before a function compiles it twice: for processors with
/// the instructions `target`, and for all. The loader selects one of the two. So a
/// binary that runs everywhere uses these instructions where they exist. A sanitizer is
/// not yet initialised when the loader selects, so that a build with a sanitizer has one
/// version only, and so has a build whose flags allow AVX anyhow.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__AVX__)
#define POISE_TARGET_CLONES(target) \
  __attribute__((target_clones(target, "default")))
#else
#define POISE_TARGET_CLONES(target)
#endif
