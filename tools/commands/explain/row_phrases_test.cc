// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tools/commands/explain/describe_row.h"

#include <gtest/gtest.h>

namespace poise {
namespace {

TEST(DescribeRow, NamesEdgesAsAPersonDoes) {
  EXPECT_EQ(DescribeRow("right_foot.cop.y_max"),
            "the CoP of the right foot at its inner edge");
  EXPECT_EQ(DescribeRow("right_foot.cop.y_min"),
            "the CoP of the right foot at its outer edge");
  EXPECT_EQ(DescribeRow("left_foot.cop.x_min"),
            "the CoP of the left foot at its rear edge");
  EXPECT_EQ(DescribeRow("torque.l_knee.max"),
            "the torque of l knee at its upper limit");
  EXPECT_EQ(DescribeRow("joint.l_knee.min"),
            "the angle of l knee at its lower limit");
}

// A force that fades in is not one that is zero.
TEST(DescribeRow, TellsNoLoadFromAsMuchAsAFootMayBear) {
  EXPECT_EQ(DescribeRow("left_foot.unilateral.fz.min"),
            "the left foot without load");
  EXPECT_EQ(DescribeRow("left_foot.unilateral.fz.max"),
            "the left foot at the most that it may bear");
  // Of logs that do not say on which side.
  EXPECT_EQ(DescribeRow("left_foot.unilateral.fz"),
            "the normal force of the left foot");
}

TEST(DescribeRow, GivesBackWhatMeansNothing) {
  EXPECT_EQ(DescribeRow("momentum.ly"), "momentum.ly");
  EXPECT_EQ(DescribeRow("frame.left_foot.wx"), "frame.left_foot.wx");
}

}  // namespace
}  // namespace poise
