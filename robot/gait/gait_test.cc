// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/gait.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>

#include "poise/dynamics/integrate.h"
#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

constexpr double kDt = 2e-3;

const Robot& Humanoid() {
  static const Robot robot = LoadHumanoid();
  return robot;
}

// The robot on a plant that does exactly what the controller expects: the
// acceleration of the plant is that of the controller's solution.
class Rig {
 public:
  Rig() : Rig(Humanoid()) {}

  // Starts in the nominal posture, turned by yaw about the world's z axis.
  explicit Rig(const Robot& robot, double yaw = 0)
      : controller_(robot, Options()), gait_(robot, Settings()) {
    state_ = {0, robot.q_nominal, Eigen::VectorXd::Zero(robot.model.tree.nv())};
    const Eigen::Quaterniond turn(
        Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    const Eigen::Quaterniond upright(state_.q.segment<4>(3));
    state_.q.head<3>() = turn * state_.q.head<3>();
    state_.q.segment<4>(3) = (turn * upright).coeffs();
    command_.tau.setZero(Humanoid().model.tree.num_joints());
    controller_.Start(state_);
    controller_.Update(state_, &command_);
  }

  void Tick() {
    gait_.Update(&controller_);
    controller_.Update(state_, &command_);
    const Tree& tree = Humanoid().model.tree;
    state_.v += kDt * controller_.report().y.head(tree.nv());
    Integrate(tree, state_.q, state_.v, kDt, state_.q);
    state_.time += kDt;
  }

  void Run(double seconds) {
    for (double t = 0; t < seconds; t += kDt) Tick();
  }

  // Changes the velocity of the whole body, as by an impulse at its center of
  // mass, m/s.
  void Kick(const Eigen::Vector2d& dv) { state_.v.segment<2>(3) += dv; }

  Eigen::Vector2d FootPlace(int foot) const {
    return controller_.contacts()[foot].X_WC.p.head<2>();
  }
  bool IsFinite() const {
    const Reference& r = controller_.reference();
    bool all = r.p_WG.allFinite() && r.v_WG.allFinite() && r.a_WG.allFinite();
    for (const FrameReference& foot : r.feet) {
      all = all && foot.X_WF.p.allFinite() && foot.V_WF_W.allFinite() &&
            foot.A_WF_W.allFinite();
    }
    return all && command_.tau.allFinite();
  }

  Gait& gait() { return gait_; }
  Controller& controller() { return controller_; }
  State& state() { return state_; }

 private:
  static ControllerOptions Options() {
    ControllerOptions options;
    options.dt = kDt;
    return options;
  }
  static GaitSettings Settings() {
    GaitSettings settings;
    settings.dt = kDt;
    return settings;
  }

  Controller controller_;
  Gait gait_;
  State state_;
  Command command_;
};

TEST(Gait, StandsWithoutAPush) {
  Rig rig;
  const Eigen::Vector3d com = rig.controller().reference().p_WG;
  rig.Run(1);
  EXPECT_EQ(rig.gait().phase(), GaitPhase::kStand);
  EXPECT_EQ(rig.gait().steps(), 0);
  EXPECT_FALSE(rig.gait().owns_com());
  EXPECT_EQ(rig.controller().reference().p_WG, com);
}

TEST(Gait, StepsOnCommandAndEndsAtRest) {
  Rig rig;
  rig.Run(0.1);
  const Eigen::Vector2d goal(0.15, rig.FootPlace(0).y() + 0.05);
  ASSERT_EQ(rig.gait().StepTo(0, goal, rig.controller()),
            StepAnswer::kAccepted);
  rig.Run(5);
  EXPECT_EQ(rig.gait().phase(), GaitPhase::kStand);
  EXPECT_LT((rig.FootPlace(0) - goal).norm(), 1e-3);
  EXPECT_LT(rig.controller().tick().v_WG.norm(), 1e-3);
  // The center of mass is amid the feet again, as in the nominal posture.
  const Eigen::Vector2d middle = (rig.FootPlace(0) + rig.FootPlace(1)) / 2;
  EXPECT_LT((rig.controller().tick().p_WG.head<2>() - middle).norm(), 0.05);
}

TEST(Gait, StepsOnCommandBeforeItsFirstTick) {
  Rig rig;
  EXPECT_EQ(rig.gait().StepTo(0, {0.1, 0.1}, rig.controller()),
            StepAnswer::kAccepted);
}

// With one arm raised, the nominal center of mass is 9 mm beside the middle of
// the feet. It comes as far beside the sole, at any heading of the robot.
TEST(Gait, ShiftsNominalCenterOfMassOverSoleAtAnyHeading) {
  Robot robot = Humanoid();
  const Tree& tree = robot.model.tree;
  robot.q_nominal[tree.q_start() + *tree.FindJoint("r_shoulder_pitch")] = -1.5;
  for (const double yaw : {0.0, 2.0}) {
    SCOPED_TRACE(yaw);
    Rig rig(robot, yaw);
    const Eigen::Vector2d p_MidG_W = rig.controller().tick().p_WG.head<2>();
    ASSERT_GT(p_MidG_W.norm(), 0.008);
    ASSERT_EQ(rig.gait().StepTo(0, rig.FootPlace(0), rig.controller()),
              StepAnswer::kAccepted);
    rig.Run(1.2);  // The shift takes 1.0 s; the foot rises after 1.3 s.
    ASSERT_EQ(rig.gait().phase(), GaitPhase::kShift);
    const Eigen::Vector2d p_WG = rig.controller().reference().p_WG.head<2>();
    // The reference keeps its goal, and the sole drifts by 5 um in the rig;
    // with mixed frames the difference is 15 mm.
    EXPECT_LT((p_WG - rig.FootPlace(1) - p_MidG_W).norm(), 1e-4);
  }
}

// The foot does not rise while the capture point is beside the other sole. A
// push by 0.2 m/s moves it by 6 cm, more than half of the sole's width.
TEST(Gait, KeepsTheFootDownUntilTheRobotIsOverTheOther) {
  Rig rig;
  rig.Run(0.1);
  const Eigen::Vector2d goal(0.1, rig.FootPlace(0).y());
  ASSERT_EQ(rig.gait().StepTo(0, goal, rig.controller()),
            StepAnswer::kAccepted);
  rig.Run(1.26);
  for (int i = 0; i < 20; ++i) {
    rig.Kick({0, 0.01});
    rig.Tick();
  }
  double time = 1.3;
  while (rig.gait().phase() == GaitPhase::kShift && time < 5) {
    rig.Tick();
    time += kDt;
  }
  ASSERT_EQ(rig.gait().phase(), GaitPhase::kSwing);
  EXPECT_TRUE(rig.gait().is_commanded());
  EXPECT_GT(time, 1.32);  // Without the push: 1.3 times 1.0 s.
  const Eigen::Vector2d half = Humanoid().feet[1].half_size;
  const Eigen::Vector2d beside = rig.gait().xi_W() - rig.FootPlace(1);
  EXPECT_TRUE((beside.cwiseAbs().array() < half.array()).all());
  rig.Run(4);
  // The rig follows its references: a millimeter is 1 % of the step.
  EXPECT_LT((rig.FootPlace(0) - goal).norm(), 1e-3);
}

// Without the task momentum, the center of mass stays amid the feet.
TEST(Gait, GivesUpAStepIfTheRobotDoesNotComeOverTheOtherFoot) {
  Rig rig;
  rig.Run(0.1);
  const Eigen::Vector2d place = rig.FootPlace(0);
  ASSERT_TRUE(rig.controller().stack().Enable("momentum", false));
  ASSERT_EQ(rig.gait().StepTo(0, {0.1, place.y()}, rig.controller()),
            StepAnswer::kAccepted);
  rig.Run(3.9);
  EXPECT_EQ(rig.gait().phase(), GaitPhase::kShift);
  rig.Run(0.2);
  EXPECT_EQ(rig.gait().phase(), GaitPhase::kStand);
  EXPECT_EQ(rig.gait().steps(), 0);
  EXPECT_LT((rig.FootPlace(0) - place).norm(), 1e-3);
}

// A kick takes the capture point 17 cm forward or 11 cm aside, beyond the sole
// of the only foot on the ground. The robot steps elsewhere than commanded, and
// ends at rest on both feet.
TEST(Gait, CatchesAKickDuringACommandedStep) {
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE(45 * i);
    Rig rig;
    rig.Run(0.1);
    ASSERT_EQ(rig.gait().StepTo(0, {0.1, 0.1}, rig.controller()),
              StepAnswer::kAccepted);
    rig.Run(1.6);
    ASSERT_EQ(rig.gait().phase(), GaitPhase::kSwing);
    ASSERT_TRUE(rig.gait().is_commanded());
    const double a = i * M_PI / 4;
    rig.Kick({0.6 * std::cos(a), 0.4 * std::sin(a)});
    rig.Run(0.1);
    EXPECT_FALSE(rig.gait().is_commanded());
    rig.Run(5);
    EXPECT_EQ(rig.gait().phase(), GaitPhase::kStand);
    EXPECT_LT(rig.controller().tick().v_WG.norm(), 0.01);
    EXPECT_GT(rig.FootPlace(0).y() - rig.FootPlace(1).y(), 0.1);
  }
}

// A velocity that takes the capture point 10 cm beyond the feet needs steps;
// they end with the feet side by side.
TEST(Gait, CatchesAKickFromEachSide) {
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE(45 * i);
    Rig rig;
    rig.Run(0.1);
    const double a = i * M_PI / 4;
    rig.Kick(0.75 * Eigen::Vector2d(std::cos(a), std::sin(a)));
    int steps = 0;
    for (double t = 0; t < 4; t += kDt) {
      rig.Tick();
      steps = std::max(steps, rig.gait().steps());
    }
    EXPECT_GE(steps, 1);
    EXPECT_EQ(rig.gait().phase(), GaitPhase::kStand);
    EXPECT_EQ(rig.gait().steps(), 0);
    EXPECT_LT(rig.controller().tick().v_WG.norm(), 0.01);
    const Eigen::Vector2d between = rig.FootPlace(0) - rig.FootPlace(1);
    EXPECT_LT(std::abs(between.x()), 0.06);
    EXPECT_GT(between.y(), 0.1);
    EXPECT_LT(between.y(), 0.25);
  }
}

TEST(Gait, RefusesAStepWithAReason) {
  Rig rig;
  rig.Run(0.1);
  Gait& gait = rig.gait();
  Controller& controller = rig.controller();
  const Eigen::Vector2d place = rig.FootPlace(0);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(gait.StepTo(2, place, controller), StepAnswer::kUnknownFoot);
  EXPECT_EQ(gait.StepTo(-1, place, controller), StepAnswer::kUnknownFoot);
  EXPECT_EQ(gait.StepTo(0, {kNan, 0}, controller), StepAnswer::kNotANumber);
  EXPECT_EQ(gait.StepTo(0, {1.5, 0.1}, controller), StepAnswer::kOutOfReach);
  // Across the other foot.
  EXPECT_EQ(gait.StepTo(0, {0, -0.3}, controller), StepAnswer::kOutOfReach);
  EXPECT_EQ(gait.phase(), GaitPhase::kStand);
  EXPECT_EQ(gait.StepTo(0, place, controller), StepAnswer::kAccepted);
  EXPECT_EQ(gait.StepTo(1, rig.FootPlace(1), controller), StepAnswer::kSteps);
  gait.Stop();
  EXPECT_EQ(gait.phase(), GaitPhase::kStand);
  EXPECT_EQ(gait.StepTo(0, place, controller), StepAnswer::kStopped);
  for (const StepAnswer answer :
       {StepAnswer::kUnknownFoot, StepAnswer::kOutOfReach, StepAnswer::kSteps,
        StepAnswer::kStopped, StepAnswer::kMoves, StepAnswer::kPushed}) {
    EXPECT_FALSE(Describe(answer).empty());
  }
}

TEST(Gait, TakesNoStepAfterStop) {
  Rig rig;
  rig.Run(0.1);
  rig.gait().Stop();
  rig.Kick({0.8, 0});
  rig.Run(0.5);
  EXPECT_EQ(rig.gait().steps(), 0);
  EXPECT_EQ(rig.gait().phase(), GaitPhase::kStand);
}

TEST(Gait, TakesNoStepOnOneLegOrInFailSafe) {
  Rig on_one_leg;
  on_one_leg.Run(0.1);
  ASSERT_TRUE(on_one_leg.controller().stance().Lift(0, 0.05));
  on_one_leg.Run(0.5);
  on_one_leg.Kick({0.8, 0});
  on_one_leg.Run(0.2);
  EXPECT_EQ(on_one_leg.gait().steps(), 0);

  Rig fail_safe;
  fail_safe.Run(0.1);
  fail_safe.Kick({0.8, 0});
  fail_safe.state().q[20] = std::numeric_limits<double>::quiet_NaN();
  fail_safe.Tick();
  EXPECT_EQ(fail_safe.gait().steps(), 0);
}

TEST(Gait, RejectsARobotWithoutTwoFeet) {
  Robot robot = Humanoid();
  robot.feet.pop_back();
  EXPECT_THROW(Gait(robot, {}), std::invalid_argument);
}

TEST(Gait, DoesNotAllocate) {
  if (!CountMalloc::IsSupported()) GTEST_SKIP() << "not under a sanitizer";
  Rig rig;
  rig.Run(0.1);
  rig.Kick({0.5, 0.6});
  CountMalloc count;
  rig.Run(1.5);
  (void)rig.gait().StepTo(0, rig.FootPlace(0), rig.controller());
  rig.Run(1.5);
  EXPECT_EQ(count.allocations(), 0);
}

// Random events at random times: kicks, commands, stops, ground that is higher
// or lower than believed, and feet that are lifted, released or put down by
// somebody else.
void HappenTo(Rig* rig) {
  Controller& controller = rig->controller();
  const int foot = *rc::gen::inRange(0, 2);
  switch (*rc::gen::inRange(0, 9)) {
    case 0:
    case 1:
    case 2:
      rig->Kick((*VectorsXd(2, 0.7)).head<2>());
      break;
    case 3:
    case 4: {
      const Eigen::Vector2d place =
          rig->FootPlace(foot) + (*VectorsXd(2, 0.3)).head<2>();
      (void)rig->gait().StepTo(foot, place, controller);
      break;
    }
    case 5:
      controller.reference().ground_z = *Numbers(0.008);
      break;
    case 6:
      // The rig has no ground: without any foot in contact it falls for ever.
      if (controller.stance().phase(1 - foot) == ContactPhase::kDown) {
        controller.stance().LetGo(foot);
      }
      break;
    case 7:
      controller.stance().PutDown(foot);
      break;
    case 8:
      rig->gait().Stop();
      break;
  }
}

// A case simulates about 7 s, so that a test has fewer cases than usual. A
// longer search sets another max_success.
const bool kFewCases = [] {
  const char* given = std::getenv("RC_PARAMS");
  const std::string parameters = given == nullptr ? "" : given;
  if (parameters.find("max_success") != parameters.npos) return false;
  return setenv("RC_PARAMS", (parameters + " max_success=12").c_str(), 1) == 0;
}();

RC_GTEST_PROP(Gait, KeepsItsPromisesUnderRandomEvents, ()) {
  Rig rig;
  Reference before = rig.controller().reference();
  bool was_stepping[2] = {false, false};
  bool owned = false;
  const auto tick = [&] {
    rig.Tick();
    RC_ASSERT(rig.IsFinite());
    const Stance& stance = rig.controller().stance();
    const Reference& now = rig.controller().reference();
    int stepping = 0;
    for (int i = 0; i < 2; ++i) {
      const bool steps = stance.phase(i) == ContactPhase::kStepping;
      if (steps && was_stepping[i]) {
        // The reference moves with its own velocity: the trapezoidal rule is
        // wrong by dt³ / 12 times the jerk, far below this for a step of 1 m
        // in 0.1 s; braking at the end stops 4 m/s within a few ticks.
        Eigen::Vector3d moved = now.feet[i].X_WF.p - before.feet[i].X_WF.p;
        moved.z() -= now.ground_z - before.ground_z;
        const Eigen::Vector3d mean =
            (now.feet[i].V_WF_W.tail<3>() + before.feet[i].V_WF_W.tail<3>()) /
            2;
        RC_ASSERT((moved - kDt * mean).norm() < 5e-3);
      }
      stepping += steps ? 1 : 0;
      was_stepping[i] = steps;
    }
    RC_ASSERT(stepping <= 1);
    // From the first step on, the gait writes the height of the center of mass
    // above the ground, which never jumps.
    const double height = now.p_WG.z() - now.ground_z;
    const double height_before = before.p_WG.z() - before.ground_z;
    if (owned) RC_ASSERT(std::abs(height - height_before) < 5e-3);
    owned = rig.gait().owns_com();
    before = now;
  };
  const int events = *rc::gen::inRange(1, 8);
  for (int e = 0; e < events; ++e) {
    HappenTo(&rig);
    const int pause = *rc::gen::inRange(1, 250);
    for (int i = 0; i < pause; ++i) tick();
  }
  for (int foot = 0; foot < 2; ++foot) {
    rig.controller().stance().PutDown(foot);
  }
  for (double t = 0; t < 6; t += kDt) tick();
  RC_ASSERT(rig.gait().phase() == GaitPhase::kStand);
  RC_ASSERT(!rig.controller().reference().pendulum.is_on);
}

}  // namespace
}  // namespace poise
