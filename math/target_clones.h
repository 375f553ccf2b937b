// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

/// A function after POISE_TARGET_CLONES(target) is compiled twice: for
/// processors with the instructions `target`, and for all. The loader of glibc
/// selects one of the two when the program starts. So a binary that runs
/// everywhere uses these instructions where they exist. There is one version
/// only in a build with a sanitizer, which is not yet initialised when the
/// loader selects; in a build whose flags allow AVX2 and fused multiply-add
/// anyhow; and for other compilers than GCC.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !(defined(__AVX2__) && defined(__FMA__))
#define POISE_TARGET_CLONES(target) \
  __attribute__((target_clones(target, "default")))
#else
#define POISE_TARGET_CLONES(target)
#endif
