// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/row_phrases.h"

#include <gtest/gtest.h>

#include <utility>

namespace poise {
namespace {

using nlohmann::json;

TEST(RowPhrases, ReadsDescriptionsFromTheSummary) {
  const RowPhrases phrases(json::parse(R"({"rows": {"warm.x.max": {
      "unit": "K", "phrase": "the heat at its upper limit", "kind": "limit",
      "task": "warm"}}})"));
  EXPECT_EQ(phrases.phrase("warm.x.max"), "the heat at its upper limit");
  EXPECT_EQ(phrases.unit("warm.x.max"), "K");
  EXPECT_EQ(phrases.kind("warm.x.max"), "limit");
  EXPECT_EQ(phrases.task("warm.x.max"), "warm");
  EXPECT_TRUE(phrases.is_limit("warm.x.max"));
}

TEST(RowPhrases, ReadsTheNameOfARowWithoutDescription) {
  const RowPhrases phrases;
  EXPECT_EQ(phrases.phrase("left_foot.cop.x_max"), "left_foot.cop.x_max");
  EXPECT_EQ(phrases.unit("momentum.lx"), "N");
  EXPECT_EQ(phrases.unit("angular_momentum.kz"), "N m");
  EXPECT_EQ(phrases.unit("newton_euler.fx"), "");
  EXPECT_EQ(phrases.task("light_joints.thumb.2"), "light_joints.thumb");
  EXPECT_EQ(phrases.kind("light_joints.thumb.2"), "");
  EXPECT_FALSE(phrases.is_limit("light_joints.thumb.2"));
  const std::pair<const char*, const char*> kinds[] = {
      {"torque.chest_yaw.min", "torque_limit"},
      {"joint.chest_yaw.max", "joint_limit"},
      {"left_foot.cop.x_max", "cop_limit"},
      {"zmp.y_min", "cop_limit"},
      {"left_foot.yaw.max", "yaw_limit"},
      {"right_foot.yaw_constant.min", "yaw_limit"},
      {"left_foot.friction.y_min", "friction_limit"},
      {"left_foot.unilateral.fz.min", "normal_force_limit"}};
  for (const auto& [name, kind] : kinds) {
    EXPECT_EQ(phrases.kind(name), kind);
    EXPECT_TRUE(phrases.is_limit(name));
  }
}

TEST(RowPhrases, IgnoresMalformedRows) {
  for (const char* text : {R"({"rows": 3})", R"({"rows": {"a.b": [1]}})",
                           R"({"rows": {"a.b": {"phrase": 2}}})", "null"}) {
    SCOPED_TRACE(text);
    EXPECT_EQ(RowPhrases(json::parse(text)).phrase("a.b"), "a.b");
  }
}

}  // namespace
}  // namespace poise
