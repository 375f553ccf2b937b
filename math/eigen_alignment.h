// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

/// An installed Poise checks here that its caller aligns Eigen's memory as its
/// libraries do. A matrix that a library allocates is freed by its caller, so
/// both must use the same allocator of Eigen. Eigen chooses the allocator by
/// EIGEN_MAX_ALIGN_BYTES and by -march; with 64 bytes, -march does not matter.
/// EIGEN_MAX_STATIC_ALIGN_BYTES decides the layout of fixed-size members.
///
/// //tools:install writes installed_alignment.h beside this file, with the
/// alignment of the libraries. In Poise's own workspace there is no such file,
/// and all code is compiled with the same flags.
#if __has_include("installed_alignment.h")
#include <Eigen/Core>

#include "installed_alignment.h"

static_assert(
    EIGEN_MAX_ALIGN_BYTES == POISE_EIGEN_MAX_ALIGN_BYTES &&
        EIGEN_DEFAULT_ALIGN_BYTES == POISE_EIGEN_MAX_ALIGN_BYTES &&
        EIGEN_MAX_STATIC_ALIGN_BYTES == POISE_EIGEN_MAX_STATIC_ALIGN_BYTES &&
        !EIGEN_MALLOC_ALREADY_ALIGNED,
    "This file aligns Eigen's memory differently from the libraries of Poise, "
    "so the program would crash. Compile all files that include Poise with the "
    "definitions of the CMake target poise::math or of pkg-config poise_math, "
    "and define no other EIGEN_MAX_ALIGN_BYTES, EIGEN_MAX_STATIC_ALIGN_BYTES, "
    "EIGEN_DONT_ALIGN or EIGEN_MALLOC_ALREADY_ALIGNED.");
#endif
