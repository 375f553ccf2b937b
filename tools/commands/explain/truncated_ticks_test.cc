// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/truncated_ticks.h"

#include <gtest/gtest.h>

namespace poise {
namespace {

using nlohmann::json;

RunStory StoryWith(const std::vector<std::pair<std::string, int>>& states) {
  RunStory story;
  double time = 0;
  for (const auto& [name, ticks] : states) {
    for (int i = 0; i < ticks; ++i) {
      story.states.Add(name, {time, 1e-3}, 1, {});
      time += 1e-3;
    }
  }
  return story;
}

TEST(TruncatedTicks, HaveNoSentenceIfAllAreSolved) {
  const RunStory story = StoryWith({{"limit_relaxed torque.l_knee.max", 3}});
  EXPECT_EQ(SayTruncated(story, {{"ticks", 10}}), "");
}

TEST(TruncatedTicks, AreCountedByLevelOverPauses) {
  const RunStory story = StoryWith({{"truncated rank_4", 2},
                                    {"truncated rank_2", 1},
                                    {"limit_relaxed", 40},
                                    {"truncated rank_4", 3}});
  EXPECT_EQ(story.states.spans().size(), 4u);
  const json summary = {
      {"ticks", 100}, {"fell_at", nullptr}, {"hqp", {{"budget_us", 300.0}}}};
  EXPECT_EQ(SayTruncated(story, summary),
            "6 of 100 ticks were not solved to the last level with a budget of "
            "300 us: level 2 in 1, level 4 in 5.");
}

TEST(TruncatedTicks, AdviseALargerBudgetIfTheRobotFell) {
  const RunStory story = StoryWith({{"truncated rank_3", 2}});
  const auto say = [&](double fell_at) {
    return SayTruncated(
        story,
        {{"ticks", 50}, {"fell_at", fell_at}, {"hqp", {{"budget_us", 99.5}}}});
  };
  const std::string fact =
      "2 of 50 ticks were not solved to the last level with a budget of 99.5 "
      "us: level 3 in 2.";
  EXPECT_EQ(say(1.5), fact + " A larger budget may have helped.");
  EXPECT_EQ(say(0), fact);  // The robot fell before.
}

// A limit of iterations ended these solves, because none took as long as the
// budget allows.
TEST(TruncatedTicks, DoNotBlameABudgetThatNoSolveSpent) {
  const RunStory story = StoryWith({{"truncated rank_3", 2}});
  json summary = {{"fell_at", 9.0}};
  summary["hqp"] = {{"budget_us", 300}, {"modelled_us", {{"max", 299}}}};
  EXPECT_EQ(SayTruncated(story, summary).find("budget"), std::string::npos);
  summary["hqp"]["modelled_us"]["max"] = 301;
  EXPECT_NE(SayTruncated(story, summary).find("with a budget of 300 us"),
            std::string::npos);
  summary["hqp"]["modelled_us"]["max"] = 299;
  summary["hqp"]["budget_clock"] = true;
  EXPECT_NE(SayTruncated(story, summary).find("with a budget of 300 us"),
            std::string::npos);
}

TEST(TruncatedTicks, NeedNoBudgetAndNoSummary) {
  const RunStory story = StoryWith({{"truncated rank_5", 7}});
  const std::string expected =
      " ticks were not solved to the last level: level 5 in 7.";
  EXPECT_EQ(SayTruncated(story, json::object()), "7" + expected);
  EXPECT_EQ(SayTruncated(StoryWith({{"truncated rank_5", 1}}), json::object()),
            "1 tick was not solved to the last level: level 5 in 1.");
  EXPECT_EQ(
      SayTruncated(
          story, {{"ticks", 9}, {"fell_at", 1.5}, {"hqp", {{"budget_us", 0}}}}),
      "7 of 9" + expected);
  EXPECT_EQ(SayTruncated(story, {{"ticks", "many"}, {"hqp", 3}}),
            "7" + expected);
}

}  // namespace
}  // namespace poise
