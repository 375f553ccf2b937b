// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/momentum_cost.h"

#include <gtest/gtest.h>

#include <limits>

namespace poise {
namespace {

using nlohmann::json;

const RowPhrases& Phrases() {
  static const RowPhrases phrases(json::parse(R"({"rows": {
      "momentum.lx": {"unit": "N", "kind": "target", "task": "momentum",
                      "phrase": "the linear momentum along x"},
      "momentum.kx": {"unit": "N m", "kind": "target", "task": "momentum",
                      "phrase": "the angular momentum about x"},
      "left.cop": {"unit": "N m", "kind": "cop_limit", "task": "cop",
                   "phrase": "left CoP"},
      "right.cop": {"unit": "N m", "kind": "cop_limit", "task": "cop",
                    "phrase": "right CoP"},
      "torque.knee": {"unit": "N m", "kind": "torque_limit",
                      "task": "torque_limits", "phrase": "knee torque"},
      "joint.neck": {"unit": "rad", "kind": "joint_limit",
                     "task": "joint_limits", "phrase": "neck stop"}}})"));
  return phrases;
}

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// The CoP limits of two feet together cost more than the torque limit of a
// knee, although a single CoP limit costs less than the knee.
TEST(MomentumCost, OrdersTasksByCost) {
  MomentumCost cost;
  cost.Look(1, 0.01, Phrases(),
            {{"left.cop", 10}, {"right.cop", 10}, {"torque.knee", 3}},
            {{"momentum.lx", 70}}, {}, kUnknown);
  const auto causes = cost.Causes();
  ASSERT_EQ(causes.size(), 2u);
  EXPECT_EQ(causes[0].task, "cop");
  EXPECT_EQ(causes[0].kind, "cop_limit");
  EXPECT_EQ(causes[0].rows.size(), 2u);
  // The rows cost 0.2, 0.2 and 0.3 of 0.7 N s.
  EXPECT_NEAR(causes[0].cost, 0.4, 1e-12);
  EXPECT_NEAR(causes[1].cost, 0.3, 1e-12);
  EXPECT_NEAR(cost.cost(), 0.7, 1e-12);
}

TEST(MomentumCost, CountsOnlyConstraintsOfTheConflict) {
  MomentumCost cost;
  const auto look = [&](double time, bool has_conflict) {
    cost.Look(
        time, 0.01, Phrases(), {{"joint.neck", 2000}, {"left.cop", 1}},
        {{"momentum.lx", 100}},
        has_conflict
            ? std::vector<std::pair<std::string, double>>{{"left.cop", 3},
                                                          {"momentum.lx", 4}}
            : std::vector<std::pair<std::string, double>>{},
        kUnknown);
  };
  look(1.00, true);
  look(1.20, false);
  ASSERT_EQ(cost.Causes().size(), 1u);
  EXPECT_EQ(cost.Causes()[0].task, "cop");
  look(2.00, false);  // Another episode, without a conflict.
  EXPECT_EQ(cost.Causes().size(), 2u);
}

// The joints reach their limits as a consequence of the fall.
TEST(MomentumCost, IgnoresConstraintsAfterTheLossExceedsTheWeight) {
  MomentumCost cost;
  constexpr double kWeight = 400;  // N.
  double time = 0;
  for (; time < 0.5; time += 0.01) {
    cost.Look(time, 0.01, Phrases(), {}, {}, {}, kWeight);
  }
  cost.Look(time, 0.01, Phrases(), {{"left.cop", 1}}, {{"momentum.lx", 100}},
            {}, kWeight);
  for (int i = 0; i < 20; ++i) {
    time += 0.01;
    cost.Look(time, 0.01, Phrases(), {{"joint.neck", 1}},
              {{"momentum.lx", 1000}}, {}, kWeight);
  }
  EXPECT_TRUE(cost.is_lost());
  EXPECT_NEAR(cost.lost_at(), 0.51, 1e-9);
  EXPECT_EQ(cost.peak(), 1000);
  ASSERT_EQ(cost.Causes().size(), 1u);
  EXPECT_EQ(cost.Causes()[0].task, "cop");
}

TEST(MomentumCost, CountsOnlyTheLastEpisode) {
  MomentumCost cost;
  cost.Look(1, 0.01, Phrases(), {{"left.cop", 1}}, {{"momentum.lx", 100}}, {},
            kUnknown);
  cost.Look(2, 0.01, Phrases(), {{"torque.knee", 1}}, {{"momentum.lx", 50}}, {},
            kUnknown);
  EXPECT_EQ(cost.from(), 2);
  EXPECT_EQ(cost.peak(), 50);
  ASSERT_EQ(cost.Causes().size(), 1u);
  EXPECT_EQ(cost.Causes()[0].task, "torque_limits");
}

// A tick that was cut off long after a push has no active row. It does not hide
// the push.
TEST(MomentumCost, ATickThatWasCutOffBeginsNoEpisode) {
  MomentumCost cost;
  cost.Look(1, 0.01, Phrases(), {{"left.cop", 1}}, {{"momentum.lx", 100}}, {},
            kUnknown);
  cost.Look(5, 0.01, Phrases(), {}, {{"momentum.lx", 1}}, {}, kUnknown);
  EXPECT_EQ(cost.from(), 1);
  EXPECT_EQ(cost.peak(), 100);
  ASSERT_EQ(cost.Causes().size(), 1u);
  // With a conflict, as between two targets, it is an episode.
  cost.Look(6, 0.01, Phrases(), {}, {{"momentum.lx", 2}}, {{"momentum.lx", 4}},
            kUnknown);
  EXPECT_EQ(cost.from(), 6);
  EXPECT_EQ(cost.peak(), 2);
}

// A loss below 0.5 N is rounding; angular momentum has another unit.
TEST(MomentumCost, IgnoresRoundingAndAngularMomentum) {
  MomentumCost cost;
  cost.Look(1, 0.01, Phrases(), {{"left.cop", 1}},
            {{"momentum.lx", 0.4}, {"momentum.kx", 100}}, {}, kUnknown);
  EXPECT_FALSE(cost.has_loss());
  EXPECT_TRUE(cost.Causes().empty());
}

}  // namespace
}  // namespace poise
