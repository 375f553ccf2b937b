// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>
#include <utility>

#include "poise/robot/input_error.h"
#include "poise/sim/log/summary.h"
#include "poise/sim/story_fixture.h"
#include "poise/tests/util/shared_data.h"
#include "poise/tests/util/test_file.h"

namespace poise {
namespace {

RunResult RunOurs(const std::string& name, double duration) {
  return poise::Run(Humanoid(), Ours(name, duration));
}

std::filesystem::path Folder(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

std::string Contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}
TEST(Run, SameSeedGivesTheSameBytesInAnyOrderAndInParallel) {
  Scenario scenario = Ours("strong_push", 1.3);
  scenario.sensors.noise = 1;
  const std::string once =
      poise::Run(Humanoid(), scenario, Folder("once")).log_sha256;
  RunOurs("weak_push", 0.2);
  std::string again, beside;
  std::thread thread([&scenario, &beside] {
    beside = poise::Run(Humanoid(), scenario, Folder("beside")).log_sha256;
  });
  again = poise::Run(Humanoid(), scenario, Folder("again")).log_sha256;
  thread.join();
  EXPECT_EQ(once.size(), 64u);
  EXPECT_EQ(again, once);
  EXPECT_EQ(beside, once);
  EXPECT_EQ(Contents(Folder("again") / "log.csv"),
            Contents(Folder("once") / "log.csv"));
  scenario.seed = 2;
  EXPECT_NE(poise::Run(Humanoid(), scenario, Folder("other")).log_sha256, once);
}

// A budget in modelled time ends many ticks of a push early. The run is still
// the same each time, and the robot stays up, since the next tick continues the
// search.
TEST(Run, IsTheSameEachTimeWithABudget) {
  Scenario scenario = Ours("strong_push", 1.3);
  scenario.control.budget_us = 100;
  const RunResult once = poise::Run(Humanoid(), scenario, Folder("budget"));
  EXPECT_GT(once.failures, 0);
  EXPECT_LT(once.failures, once.ticks / 2);
  EXPECT_FALSE(once.verdict.fell_at.has_value());
  EXPECT_EQ(once.torque_limit_violation_peak, 0);
  EXPECT_EQ(poise::Run(Humanoid(), scenario, Folder("budget_again")).log_sha256,
            once.log_sha256);
  // Without the budget, each tick is solved, and the log is another one.
  scenario.control.budget_us = 0;
  const RunResult whole = poise::Run(Humanoid(), scenario, Folder("whole"));
  EXPECT_EQ(whole.failures, 0);
  EXPECT_NE(whole.log_sha256, once.log_sha256);
}

TEST(Run, WritesOneRowPerTickAndStopsOnRequest) {
  Scenario scenario = Ours("weak_push", 2);
  const RunResult result = poise::Run(Humanoid(), scenario, Folder("stopped"),
                                      [](double done) { return done < 0.105; });
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.ticks, 220);
  const std::string log = Contents(Folder("stopped") / "log.csv");
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 221);
  EXPECT_EQ(log.back(), '\n');
  EXPECT_EQ(log.substr(0, 8), "time[s],");
  const auto summary = ToJson(Humanoid(), scenario, result);
  EXPECT_EQ(summary["ticks"], 220);
  EXPECT_EQ(summary["log_sha256"], result.log_sha256);
  const auto row = summary["rows"]["torque.l_knee.max"];
  EXPECT_EQ(row["unit"], "N m");
  EXPECT_EQ(row["phrase"], "the torque of l knee at its upper limit");
  EXPECT_EQ(row["kind"], "torque_limit");
  EXPECT_EQ(row["task"], "torque_limits");
  EXPECT_EQ(summary["fell_at"], nullptr);
}

// A robot that stands may fall later; a fall is final.
TEST(Run, DoesNotJudgeAnInterruptedRunWithoutAFall) {
  const Scenario scenario = Ours("weak_push", 2);
  RunResult result;
  result.interrupted = true;
  result.verdict.recovered = true;
  EXPECT_EQ(ToJson(Humanoid(), scenario, result)["recovered"], nullptr);
  EXPECT_EQ(ToTable(Humanoid(), scenario, result).find("weak_push: interrup"),
            0u);
  result.verdict.recovered = false;
  result.verdict.fell_at = 1.25;
  EXPECT_EQ(ToJson(Humanoid(), scenario, result)["recovered"], false);
  EXPECT_EQ(ToTable(Humanoid(), scenario, result).find("weak_push: fell at 1"),
            0u);
}

// Until 0.5 s after a push, the robot may still fall because of the push.
TEST(Run, DoesNotRecoverSoonAfterAPush) {
  Scenario scenario = Ours("weak_push", 0.64);
  Push& push = scenario.pushes[0];
  push.force /= 50;
  push.start = 0;  // Ends at 0.15 s.
  const auto outcome = [&scenario] {
    const RunResult result = poise::Run(Humanoid(), scenario);
    EXPECT_FALSE(result.verdict.fell_at);
    const std::string table = ToTable(Humanoid(), scenario, result);
    return std::pair(result.verdict.recovered,
                     table.substr(0, table.find('\n')));
  };
  EXPECT_EQ(outcome(),
            std::pair(false, std::string("weak_push: not recovered: the run "
                                         "ends 0.49 s after the end of the "
                                         "push, recovery needs 0.5 s after "
                                         "it")));
  scenario.duration = 0.65;
  EXPECT_EQ(outcome(), std::pair(true, std::string("weak_push: recovered")));
  scenario.duration = 0.1;
  EXPECT_EQ(outcome(),
            std::pair(false, std::string("weak_push: not recovered: the run "
                                         "ends 0.05 s before the end of the "
                                         "push, recovery needs 0.5 s after "
                                         "it")));
}

TEST(Run, RejectsUnknownTasks) {
  Scenario scenario = Ours("stand", 1);
  scenario.control.with = {"levitate"};
  EXPECT_THROW(poise::Run(Humanoid(), scenario), std::invalid_argument);
}

// Nao's fingers have a mass of 2 mg and no limits. The controller must not
// balance a push by accelerating them, at 1e8 rad/s2, if the feet can balance
// the push.
TEST(Run, NaoRecoversWithoutFlingingItsFingers) {
  const auto robots = SharedData("robots");
  if (!robots) GTEST_SKIP() << "the shared robot files are missing";
  const Robot nao = LoadStandingRobot(*robots / "nao_v50.urdf");
  Scenario scenario = Ours("strong_push", 3);
  scenario.pushes[0].force *= 0.15;
  const RunResult result = poise::Run(nao, scenario);
  EXPECT_TRUE(result.verdict.recovered) << result.verdict.fell_by;
  EXPECT_EQ(result.failures, 0);
}

// With the CoM over the middle of a foot, Nao's hip would be at its limit and
// other tasks would be violated. The CoM must stay on the inner side of the
// sole.
TEST(Run, NaoStandsOnOneLeg) {
  const auto robots = SharedData("robots");
  if (!robots) GTEST_SKIP() << "the shared robot files are missing";
  Scenario scenario = Ours("one_leg", 9);
  scenario.pushes.clear();  // The push is too strong for Nao.
  const RunResult result =
      poise::Run(LoadStandingRobot(*robots / "nao_v50.urdf"), scenario);
  EXPECT_TRUE(result.verdict.recovered) << result.verdict.fell_by;
}

TEST(ClosedLoop, ShiftsOverTheInnerSideOfAFoot) {
  Scenario scenario = Ours("stand", 1);
  scenario.start = {};
  StanceEvent shift;
  shift.foot = "left_foot";
  shift.over = 0.01;
  for (const double at : {0.0, 0.001}) {  // Before the first tick, and later.
    shift.at = at;
    scenario.stance = {shift};
    ClosedLoop loop(Humanoid(), scenario);
    const Eigen::Vector3d start = loop.controller().reference().p_WG;
    for (int k = 0; k < 14; ++k) loop.Tick();
    const double foot = loop.record().observation.feet[0].X_WC.p.y();
    const double inside = 0.25 * Humanoid().feet[0].half_size.y();
    const Eigen::Vector3d way = loop.controller().reference().p_WG - start;
    EXPECT_LT((way - Eigen::Vector3d(0, foot - inside, 0)).norm(), 1e-5);
  }
}

// Frame tasks exist for every link, not only for the feet.
TEST(ClosedLoop, HasAFrameTaskForAnyLink) {
  Scenario scenario = Ours("stand", 1);
  scenario.control.tasks =
      TestFile("set.yaml", "tasks: {frame.l_hand: {rank: 5, on: true}}");
  scenario.control.with = {"frame.torso"};
  const ClosedLoop loop(Humanoid(), scenario);
  const Stack& stack = loop.controller().stack();
  for (const auto& [task, level] :
       {std::pair("frame.torso", 4), std::pair("frame.l_hand", 5)}) {
    const TaskSettings& settings = stack.settings(stack.Find(task).value());
    EXPECT_TRUE(settings.enabled) << task;
    EXPECT_EQ(settings.level, level) << task;
  }
}

// The gains are unstable at 100 Hz and the limits are off. So joints move
// faster than in any fall.
TEST(Run, DistinguishesABlowUpFromAFall) {
  Scenario scenario = Ours("stand", 1);
  scenario.control.dt = 0.01;
  scenario.control.tasks =
      TestFile("wild.yaml",
               "tasks: {joint_limits: off, torque_limits: off, "
               "posture: {kp: 10000, kd: 1000}}");
  const RunResult wild = poise::Run(Humanoid(), scenario);
  EXPECT_TRUE(wild.verdict.fell_at.has_value());
  EXPECT_EQ(FellBy(wild).find("the controller blew up: joint '"), 0u)
      << FellBy(wild);
  EXPECT_EQ(ToJson(Humanoid(), scenario, wild)["fell_by"], FellBy(wild));
  // A push that no controller could balance gives an ordinary fall.
  Scenario hard = Ours("strong_push", 3);
  hard.pushes[0].force *= 3;
  const RunResult fallen = poise::Run(Humanoid(), hard);
  EXPECT_TRUE(fallen.verdict.fell_at.has_value());
  EXPECT_EQ(FellBy(fallen), fallen.verdict.fell_by);
  EXPECT_EQ(FellBy(RunResult()), "");
}

// With a delay of three ticks, the plant applies the torques that the
// controller commanded three ticks before.
// Right after the lift, only the left foot is meant to be down. The CoM is
// still amid the feet, outside of the left sole.
TEST(Run, SaysThatAFractionOfABoundOfZeroIsNoPush) {
  Scenario scenario = Ours("stand", 0.3);
  StanceEvent lift;
  lift.kind = StanceEvent::Kind::kLift;
  lift.foot = "right_foot";
  lift.at = 0.1;
  scenario.stance = {lift};
  scenario.pushes.emplace_back();
  scenario.pushes[0].force = {0, 20, 0};
  scenario.pushes[0].impulse_fraction = 0.3;
  scenario.pushes[0].start = 0.2;
  const RunResult result = poise::Run(Humanoid(), scenario);
  EXPECT_EQ(result.commanded_done, false);
  ASSERT_EQ(result.not_done.size(), 1u);
  EXPECT_EQ(result.not_done[0].rfind("push at 0.2 s: its force is 0 N", 0), 0u)
      << result.not_done[0];
}

TEST(ClosedLoop, RejectsAFractionOfABoundInNoTime) {
  Scenario scenario = Ours("stand", 0.3);
  scenario.pushes.emplace_back();
  scenario.pushes[0].force = {0, 20, 0};
  scenario.pushes[0].duration = 0;
  EXPECT_NO_THROW(ClosedLoop(Humanoid(), scenario));
  scenario.pushes[0].impulse_fraction = 0.3;
  EXPECT_THROW(ClosedLoop(Humanoid(), scenario), std::invalid_argument);
}

TEST(ClosedLoop, RejectsAFractionOfABoundBelowTheSoles) {
  Scenario scenario = Ours("stand", 0.3);
  scenario.pushes.emplace_back();
  scenario.pushes[0].force = {0, 20, 0};
  scenario.pushes[0].point = Eigen::Vector3d(0, 0, -2);
  EXPECT_NO_THROW(ClosedLoop(Humanoid(), scenario));
  scenario.pushes[0].impulse_fraction = 0.3;
  try {
    const ClosedLoop loop(Humanoid(), scenario);
    FAIL() << "accepted a push below the soles";
  } catch (const InputError& error) {
    EXPECT_EQ(error.field(), "pushes[0].point");
    EXPECT_NE(std::string(error.what()).find("is below the soles"),
              std::string::npos)
        << error.what();
  }
}

// The push begins in the second half of a tick, in which it already acts. The
// CoM has moved to the left foot since the start, so that the bound is another.
TEST(ClosedLoop, SizesAPushThatBeginsWithinATick) {
  Scenario scenario = Ours("stand", 3);
  StanceEvent shift;
  shift.foot = "left_foot";
  shift.at = 0.1;
  shift.over = 0.5;
  scenario.stance = {shift};
  scenario.pushes.emplace_back();
  scenario.pushes[0].force = {0, -20, 0};
  scenario.pushes[0].impulse_fraction = 0.1;
  scenario.pushes[0].start = 0.8007;
  scenario.plant.dt = 1e-4;
  ClosedLoop loop(Humanoid(), scenario);
  const double nominal = loop.scenario().pushes[0].force.norm();
  while (loop.time() < 0.8005) loop.Tick();
  const double sized = loop.scenario().pushes[0].force.norm();
  EXPECT_GT(sized, 1.2 * nominal);  // Its way to the right edge is longer.
  // The push acts in three of the ten plant steps of its first tick. Rounding
  // of sums of ten forces of some 10 N.
  EXPECT_NEAR(loop.record().push_force_W.norm(), 0.3 * sized, 1e-9);
}

TEST(ClosedLoop, DelaysTorques) {
  Scenario scenario = Ours("strong_push", 1);
  scenario.control.delay = 3e-3;
  ClosedLoop loop(Humanoid(), scenario);
  std::vector<Eigen::VectorXd> asked;
  for (int k = 0; k < 20; ++k) {
    loop.Tick();
    asked.push_back(loop.record().tau);
    if (k >= 3) {
      EXPECT_EQ(loop.plant().Sense().tau, asked[k - 3]);
    }
  }
}

TEST(ClosedLoop, ControlsAtALowerRateThanThePlant) {
  Scenario scenario = Ours("strong_push", 1);
  scenario.control.dt = 5e-3;
  ClosedLoop loop(Humanoid(), scenario);
  for (int k = 0; k < 10; ++k) loop.Tick();
  EXPECT_NEAR(loop.time(), 0.05, 1e-12);
  const Observation& now = loop.observation();
  EXPECT_NEAR(now.time, 0.045, 1e-12);
}

}  // namespace
}  // namespace poise
