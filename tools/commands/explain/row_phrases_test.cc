// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/row_phrases.h"

#include <gtest/gtest.h>

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

TEST(RowPhrases, UsesTheNameOfARowWithoutDescription) {
  const RowPhrases phrases;
  EXPECT_EQ(phrases.phrase("left_foot.cop.x_max"), "left_foot.cop.x_max");
  EXPECT_EQ(phrases.unit("momentum.lx"), "");
  EXPECT_EQ(phrases.task("light_joints.thumb.2"), "light_joints.thumb");
  EXPECT_FALSE(phrases.is_limit("left_foot.cop.x_max"));
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
