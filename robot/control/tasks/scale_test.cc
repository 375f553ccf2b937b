// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/scale.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

namespace poise {
namespace {

Tree MakeBlock(double mass, double gravity) {
  Inertia M;
  M.mass = mass;
  M.I_G_B = Eigen::Matrix3d::Identity();
  TreeBuilder builder;
  builder.AddLink("block", M).SetGravity({0, 0, -gravity});
  return builder.Build();
}

TEST(ForceScale, IsAQuarterOfTheWeightInTheGravityOfTheTree) {
  EXPECT_EQ(ForceScale(MakeBlock(8, 9.81)), 8 * 9.81 / 4);
  EXPECT_DOUBLE_EQ(ForceScale(MakeBlock(8, 1.62)), 8 * 1.62 / 4);
}

TEST(ForceScale, IsOneWithoutWeight) {
  EXPECT_EQ(ForceScale(MakeBlock(8, 0)), 1);
}

}  // namespace
}  // namespace poise
