// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <cmath>
#include <string_view>

#include "poise/robot/feet/find_feet.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/tests/fuzz/fuzzing.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using poise::Require;
  poise::ExpectReadsOrRefuses([&] {
    const poise::RobotModel model = poise::ParseUrdf(
        std::string_view(reinterpret_cast<const char*>(data), size), "fuzzed");
    const poise::Tree& tree = model.tree;
    Require(std::isfinite(tree.total_mass()), "mass is finite");
    Require(tree.total_mass() >= 0, "mass is not negative");
    Require(static_cast<int>(model.limits.size()) == tree.num_joints(),
            "each joint has its limits");
    for (const poise::JointLimits& limits : model.limits) {
      Require(limits.lower <= limits.upper, "limits are ordered");
    }
    for (const poise::Joint& joint : tree.joints()) {
      Require(std::abs(joint.axis_F.norm() - 1) < 1e-9,
              "joint axes are unit vectors");
    }
    for (const poise::Frame& frame : tree.frames()) {
      Require(frame.X_BF.R.allFinite() && frame.X_BF.p.allFinite(),
              "frames are finite");
    }
    for (const poise::Foot& foot : poise::FindFeet(model)) {
      Require(foot.half_size.minCoeff() > 0, "a sole has a positive area");
    }
  });
  return 0;
}
