// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/profile.h"
#include "poise/tests/fuzz/fuzzing.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const poise::MemoryFile file(data, size);
  poise::ExpectReadsOrRefuses([&] {
    const poise::Profile profile = poise::LoadProfile(file.path());
    poise::Require((!profile.base_xyz || profile.base_xyz->allFinite()) &&
                       profile.base_rpy.allFinite(),
                   "the pose of the base is finite");
    for (const poise::SoleProfile& sole : profile.feet) {
      for (const Eigen::Vector2d& corner : sole.sole_S) {
        poise::Require(corner.allFinite(), "the corners of a sole are finite");
      }
    }
  });
  return 0;
}
