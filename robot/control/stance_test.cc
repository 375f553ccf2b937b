// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/stance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "poise/math/so3.h"

namespace poise {
namespace {

using Eigen::Vector3d;

constexpr double kHalfWidth = 0.05;

std::vector<Foot> TwoFeet() {
  std::vector<Foot> feet(2);
  for (Foot& foot : feet) {
    foot.half_size = {0.1, kHalfWidth};
    foot.polygon_C = {{0.1, kHalfWidth},
                      {-0.1, kHalfWidth},
                      {-0.1, -kHalfWidth},
                      {0.1, -kHalfWidth}};
  }
  return feet;
}

// Expects that the pose, velocity and acceleration of a target are consistent
// from tick to tick.
void ExpectMovesAsItSays(const FrameReference& last,
                         const FrameReference& now) {
  Eigen::Matrix<double, 6, 1> moved;
  moved << LogSo3(now.X_WF.R * last.X_WF.R.transpose()),
      now.X_WF.p - last.X_WF.p;
  // Error of the trapezoidal rule: third derivative, 60 * 0.6 / (0.35 s)^3,
  // times dt^3 / 12.
  EXPECT_LT((moved - 5e-4 * (last.V_WF_W + now.V_WF_W)).norm(), 7e-8);
  EXPECT_LT(
      (now.V_WF_W - last.V_WF_W - 5e-4 * (last.A_WF_W + now.A_WF_W)).norm(),
      3e-6);  // Fourth derivative: 360 * 0.6 / (0.35 s)^4.
}

class StanceTest : public testing::Test {
 protected:
  StanceTest() {
    for (ContactTick& contact : contacts_) contact.V_WC_C.setZero();
    reference_.feet.resize(2);
  }

  // Updates for the debounce time lost_after, 3 ms.
  void UpdateForLost() {
    for (int i = 0; i < 3; ++i) {
      EXPECT_NE(stance_.phase(0), ContactPhase::kLost);
      EXPECT_NE(stance_.phase(1), ContactPhase::kLost);
      Update();
    }
  }

  void Update() {
    stance_.Update(1e-3, Eigen::Vector2d(200, 100), &contacts_, &reference_);
  }

  // Rolls the left foot about its outer edge, whose height is `edge`.
  void Roll(double angle, double edge) {
    contacts_[0].X_WC.R = ExpSo3(Vector3d(angle, 0, 0));
    contacts_[0].X_WC.p.z() = edge + kHalfWidth * std::sin(std::abs(angle));
  }

  Stance stance_ = Stance(TwoFeet(), 400);
  std::vector<ContactTick> contacts_ = std::vector<ContactTick>(2);
  Reference reference_;
};

// The center of the sole is 3 cm above the ground, and rises.
TEST_F(StanceTest, KeepsContactOfFootOnItsEdge) {
  for (const double angle : {0.6, -0.6}) {
    Roll(angle, 0);
    // The foot turns about this edge, so that its center moves up.
    contacts_[0].V_WC_C.head<3>() = Vector3d(angle, 0, 0);
    contacts_[0].V_WC_C.tail<3>() =
        Vector3d(angle, 0, 0)
            .cross(Vector3d(0, angle > 0 ? kHalfWidth : -kHalfWidth, 0));
    Update();
    EXPECT_TRUE(contacts_[0].in_contact) << angle;
    EXPECT_EQ(stance_.phase(0), ContactPhase::kDown) << angle;
  }
}

TEST_F(StanceTest, LosesContactOfRisingFoot) {
  Roll(0.6, 0.011);
  Update();
  EXPECT_TRUE(contacts_[0].in_contact);  // The foot does not rise.
  contacts_[0].V_WC_C[5] = 0.03;
  UpdateForLost();
  EXPECT_FALSE(contacts_[0].in_contact);
  EXPECT_EQ(stance_.phase(0), ContactPhase::kLost);
  EXPECT_TRUE(stance_.is_meant_down(0));
  EXPECT_TRUE(contacts_[1].in_contact);
}

// One or two samples above the ground do not end the contact. A foot that was
// not seen on the ground since Reset() is lost at once.
TEST_F(StanceTest, DebouncesLossOfContact) {
  const auto lost_at = [this](bool is_high) {
    contacts_[0].X_WC.p.z() = is_high ? 0.03 : 0;
    Update();
    return stance_.phase(0) == ContactPhase::kLost;
  };
  EXPECT_FALSE(lost_at(false));
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(lost_at(true));
    EXPECT_FALSE(lost_at(true));
    EXPECT_FALSE(lost_at(false));
  }
  EXPECT_FALSE(lost_at(true));
  EXPECT_FALSE(lost_at(true));
  EXPECT_TRUE(lost_at(true));
  stance_.Reset();
  EXPECT_TRUE(lost_at(true));
  // The debounce counts time, not ticks.
  stance_.Reset();
  EXPECT_FALSE(lost_at(false));
  contacts_[0].X_WC.p.z() = 0.03;
  stance_.Update(5e-3, Eigen::Vector2d(200, 100), &contacts_, &reference_);
  EXPECT_EQ(stance_.phase(0), ContactPhase::kLost);
}

// The lowest edge of a rolled foot is at 11 mm: only the speed of this edge
// counts.
TEST_F(StanceTest, UsesSpeedOfLowestEdgeForLossOfContact) {
  for (const double angle : {0.6, -0.6}) {
    SCOPED_TRACE(angle);
    stance_.Reset();
    Roll(angle, 0.011);
    const Vector3d edge_C(0, angle > 0 ? -kHalfWidth : kHalfWidth, 0);
    const Vector3d w_C(angle, 0, 0);
    contacts_[0].V_WC_C << w_C, w_C.cross(-edge_C);  // About that edge.
    Update();
    EXPECT_TRUE(contacts_[0].in_contact);
    contacts_[0].V_WC_C << -w_C, Vector3d::Zero();  // It rises by 25 mm/s.
    UpdateForLost();
    EXPECT_FALSE(contacts_[0].in_contact);
  }
}

TEST_F(StanceTest, KeepsContactBelowThresholdAtAnySpeed) {
  Roll(0, 0.009);
  contacts_[0].V_WC_C[5] = 1;
  Update();
  EXPECT_TRUE(contacts_[0].in_contact);
}

TEST_F(StanceTest, LosesContactOfHighFootAtRest) {
  Roll(0.6, 0.021);
  Update();
  EXPECT_FALSE(contacts_[0].in_contact);
}

TEST_F(StanceTest, FindsContactWhenSoleLiesOnGround) {
  Roll(0, 0.03);
  Update();
  ASSERT_EQ(stance_.phase(0), ContactPhase::kLost);
  Roll(0.6, 0);
  Update();
  EXPECT_FALSE(contacts_[0].in_contact);
  Roll(0, 0.003);
  contacts_[0].V_WC_C[5] = 0.03;
  Update();
  EXPECT_FALSE(contacts_[0].in_contact);  // The sole rises.
  contacts_[0].X_WC.R = ExpSo3(Vector3d(0.5, 0, 0));
  contacts_[0].V_WC_C.tail<3>() = Vector3d(0, 0.1, 0);
  Update();
  EXPECT_FALSE(contacts_[0].in_contact);  // Moves up, along its y axis.
  Roll(0, 0.005);
  contacts_[0].V_WC_C.tail<3>() = Vector3d(0, 0, -0.03);
  Update();
  EXPECT_FALSE(contacts_[0].in_contact);  // Still too high.
  Roll(0, 0.003);
  Update();
  EXPECT_TRUE(contacts_[0].in_contact);
  EXPECT_EQ(stance_.phase(0), ContactPhase::kLoading);
  EXPECT_LT(contacts_[0].max_normal_force, 10);
  for (int i = 0; i < 150; ++i) Update();
  // Half of the final bound, 1.5 times the weight.
  EXPECT_NEAR(contacts_[0].max_normal_force, 300, 3);
  for (int i = 0; i <= 150; ++i) Update();
  EXPECT_EQ(stance_.phase(0), ContactPhase::kDown);
  EXPECT_TRUE(std::isinf(contacts_[0].max_normal_force));
}

// While no foot is in contact, the feet move with the body. A foot whose lower
// edge lands is then in contact at once, with its full force, even if not
// level.
TEST_F(StanceTest, LandsOnTiltedFootAfterFlight) {
  const auto lift_all = [&] {
    for (ContactTick& contact : contacts_) {
      contact.X_WC.R.setIdentity();
      contact.X_WC.p.z() = 0.03;
    }
    Update();
    ASSERT_EQ(stance_.phase(0), ContactPhase::kLost);
    ASSERT_EQ(stance_.phase(1), ContactPhase::kLost);
    EXPECT_FALSE(contacts_[0].is_guided);
    EXPECT_FALSE(contacts_[1].is_guided);
  };
  lift_all();
  Roll(0.6, 0.005);
  contacts_[0].V_WC_C[5] = -1;
  Update();
  EXPECT_EQ(stance_.phase(0), ContactPhase::kLost);  // 1 mm too high.
  Roll(0.6, 0.003);
  Update();
  EXPECT_EQ(stance_.phase(0), ContactPhase::kDown);
  EXPECT_TRUE(contacts_[0].in_contact);
  EXPECT_TRUE(std::isinf(contacts_[0].max_normal_force));
  EXPECT_FALSE(contacts_[1].in_contact);
  EXPECT_TRUE(contacts_[1].is_guided);
  contacts_[1].X_WC.p.z() = 0.003;
  Update();
  EXPECT_EQ(stance_.phase(1), ContactPhase::kDown);
  // Without a flight: a foot that lost contact alone is loaded gradually.
  contacts_[1].X_WC.p.z() = 0.03;
  UpdateForLost();
  ASSERT_EQ(stance_.phase(1), ContactPhase::kLost);
  EXPECT_TRUE(contacts_[1].is_guided);
  contacts_[1].X_WC.p.z() = 0.003;
  Update();
  EXPECT_EQ(stance_.phase(1), ContactPhase::kLoading);
}

// In flight, a foot that was lifted on command moves with the body too. It does
// not become a contact at landing.
TEST_F(StanceTest, KeepsLiftedFootUpInFlight) {
  ASSERT_TRUE(stance_.Lift(1, 0.05));
  for (int i = 0; i < 302; ++i) Update();
  ASSERT_EQ(stance_.phase(1), ContactPhase::kUp);
  EXPECT_TRUE(contacts_[1].is_guided);
  Roll(0, 0.03);
  UpdateForLost();
  ASSERT_EQ(stance_.phase(0), ContactPhase::kLost);
  EXPECT_FALSE(contacts_[1].is_guided);
  EXPECT_EQ(stance_.phase(1), ContactPhase::kUp);
  contacts_[1].X_WC.p.z() = 0.003;
  Roll(0, 0.003);
  Update();
  EXPECT_EQ(stance_.phase(0), ContactPhase::kDown);
  EXPECT_EQ(stance_.phase(1), ContactPhase::kUp);
  EXPECT_TRUE(contacts_[1].is_guided);
  EXPECT_FALSE(contacts_[1].in_contact);
}

// A released foot is put down from a distant pose. Its target starts at the
// present pose, ends at the take-off place, and is consistent with its velocity
// and acceleration.
TEST_F(StanceTest, ReleasesFootAndBringsItBack) {
  contacts_[0].X_WC.p = Vector3d(1, 2, 0);
  stance_.LetGo(0);
  Update();
  EXPECT_EQ(stance_.phase(0), ContactPhase::kFree);
  EXPECT_FALSE(stance_.is_meant_down(0));
  EXPECT_FALSE(contacts_[0].in_contact);
  EXPECT_FALSE(contacts_[0].is_guided);
  EXPECT_TRUE(contacts_[1].in_contact);
  EXPECT_TRUE(contacts_[1].is_guided);

  const Pose away{ExpSo3(Vector3d(0.4, -0.2, 0.1)), Vector3d(0.9, 2.3, 0.1)};
  contacts_[0].X_WC = away;
  const Vector3d v_W(0.2, -0.5, 0.1);
  contacts_[0].V_WC_C.tail<3>() = away.R.transpose() * v_W;
  stance_.PutDown(0);
  EXPECT_EQ(stance_.phase(0), ContactPhase::kReturning);
  const FrameReference& target = reference_.feet[0];
  Update();
  EXPECT_TRUE(contacts_[0].is_guided);
  EXPECT_FALSE(contacts_[0].in_contact);
  // Tolerance: effect of the minimum-jerk curve in 1 ms.
  EXPECT_LT((target.X_WF.p - away.p - 1e-3 * v_W).norm(), 1e-6);
  EXPECT_LT((target.V_WF_W.tail<3>() - v_W).norm(), 1e-3);
  EXPECT_LT(LogSo3(target.X_WF.R * away.R.transpose()).norm(), 1e-6);
  FrameReference last = target;
  bool was_turning = false;
  for (int i = 1; i < 500; ++i) {
    Update();
    ExpectMovesAsItSays(last, target);
    if (target.V_WF_W.head<3>().norm() > 0.1) was_turning = true;
    last = target;
    if (i > 350) {
      EXPECT_LT(target.V_WF_W.head<3>().norm(), 1e-12);  // Flat.
    }
  }
  EXPECT_TRUE(was_turning);
  Update();
  EXPECT_LT((target.X_WF.p - Vector3d(1, 2, -0.005)).norm(), 1e-9);
  EXPECT_LT(LogSo3(target.X_WF.R).norm(), 1e-9);
  EXPECT_LT(target.V_WF_W.norm(), 1e-4);
  EXPECT_EQ(stance_.phase(0), ContactPhase::kReturning);
  contacts_[0].V_WC_C.setZero();
  Roll(0, 0);
  Update();
  EXPECT_EQ(stance_.phase(0), ContactPhase::kLoading);
  EXPECT_TRUE(contacts_[0].in_contact);
  EXPECT_TRUE(stance_.is_meant_down(0));
}

TEST_F(StanceTest, ReturnStartsFromPresentRotation) {
  stance_.LetGo(0);
  Update();
  const Eigen::Matrix3d R_WC = ExpSo3(Vector3d(0.4, -0.2, 0.1));
  contacts_[0].X_WC = {R_WC, Vector3d(0, 0, 0.1)};
  const Vector3d w_W(0.5, 0.7, -0.3);
  contacts_[0].V_WC_C.head<3>() = R_WC.transpose() * w_W;
  stance_.PutDown(0);
  Update();
  const FrameReference& target = reference_.feet[0];
  EXPECT_LT((target.V_WF_W.head<3>() - w_W).norm(), 1e-3);
  EXPECT_LT((LogSo3(target.X_WF.R * R_WC.transpose()) - 1e-3 * w_W).norm(),
            1e-6);
}

// The motion of a released foot that is lifted starts from its present pose and
// speed. It ends upright above the take-off place.
TEST_F(StanceTest, LiftsReleasedFootFromPresentPose) {
  const FrameReference& target = reference_.feet[0];
  const Pose away{ExpSo3(Vector3d(0.4, -0.2, 0.1)), Vector3d(0.9, 2.3, 0.1)};
  const Vector3d v_W(0.2, -0.5, -0.15);
  for (const bool returning : {false, true}) {
    SCOPED_TRACE(returning);
    stance_.Reset();
    contacts_[0].X_WC = {Eigen::Matrix3d::Identity(), Vector3d(1, 2, 0)};
    contacts_[0].V_WC_C.setZero();
    stance_.LetGo(0);
    Update();
    contacts_[0].X_WC = away;
    contacts_[0].V_WC_C.tail<3>() = away.R.transpose() * v_W;
    if (returning) {
      stance_.PutDown(0);
      for (int i = 0; i < 100; ++i) Update();
      ASSERT_EQ(stance_.phase(0), ContactPhase::kReturning);
    }
    ASSERT_TRUE(stance_.Lift(0, 0.05));
    EXPECT_FALSE(stance_.is_meant_down(0));
    Update();
    EXPECT_FALSE(contacts_[0].in_contact);
    EXPECT_TRUE(contacts_[0].is_guided);
    // Tolerance: effect of the minimum-jerk curve in 1 ms.
    EXPECT_LT((target.X_WF.p - away.p - 1e-3 * v_W).norm(), 1e-6);
    EXPECT_LT((target.V_WF_W.tail<3>() - v_W).norm(), 1e-3);
    EXPECT_LT(LogSo3(target.X_WF.R * away.R.transpose()).norm(), 1e-6);
    FrameReference last = target;
    for (int i = 0; i < 600; ++i) {
      Update();
      ExpectMovesAsItSays(last, target);
      EXPECT_GT(target.X_WF.p.z(), 0);
      last = target;
    }
    EXPECT_EQ(stance_.phase(0), ContactPhase::kUp);
    EXPECT_LT((target.X_WF.p - Vector3d(1, 2, 0.05)).norm(), 1e-9);
    EXPECT_LT(LogSo3(target.X_WF.R).norm(), 1e-9);
    EXPECT_LT(target.V_WF_W.norm(), 1e-9);
  }
}

// A returning foot on its way up is not a contact, even at a small height. When
// it is put down, it moves down from its present pose.
TEST_F(StanceTest, PutsReturningFootDown) {
  stance_.LetGo(0);
  Update();
  contacts_[0].X_WC.p = Vector3d(0.1, 0.2, 0.003);
  ASSERT_TRUE(stance_.Lift(0, 0.05));
  for (int i = 0; i < 100; ++i) {
    Update();
    ASSERT_EQ(stance_.phase(0), ContactPhase::kReturning);
  }
  contacts_[0].X_WC.p.z() = 0.02;
  stance_.PutDown(0);
  const FrameReference& target = reference_.feet[0];
  Update();
  EXPECT_LT((target.X_WF.p - Vector3d(0.1, 0.2, 0.02)).norm(), 1e-6);
  for (int i = 0; i < 500; ++i) Update();
  EXPECT_LT((target.X_WF.p - Vector3d(0, 0, -0.005)).norm(), 1e-9);
  contacts_[0].X_WC.p = Vector3d(0, 0, 0.003);
  Update();
  EXPECT_EQ(stance_.phase(0), ContactPhase::kLoading);
}

// A foot in the phase kUp lands in the same way, whether it was released or
// not.
TEST_F(StanceTest, PutsDownFootThatWasReleasedAndLifted) {
  stance_.LetGo(0);
  Update();
  contacts_[0].X_WC.p = Vector3d(0.1, 0.2, 0.1);
  ASSERT_TRUE(stance_.Lift(0, 0.05));
  for (int i = 0; i < 502; ++i) Update();
  ASSERT_EQ(stance_.phase(0), ContactPhase::kUp);
  stance_.PutDown(0);
  EXPECT_EQ(stance_.phase(0), ContactPhase::kLanding);
  FrameReference last = reference_.feet[0];
  for (int i = 0; i < 1201; ++i) {
    Update();
    ExpectMovesAsItSays(last, reference_.feet[0]);
    last = reference_.feet[0];
    if (i != 799) continue;
    EXPECT_LT(last.X_WF.p.norm(), 1e-9);
  }
  EXPECT_LT((last.X_WF.p - Vector3d(0, 0, -0.005)).norm(), 1e-9);
}

// Contact is found only after the ground has stopped the sole. With contact too
// early, the controller would press on a foot in the air, which would tilt.
TEST_F(StanceTest, FindsContactWhenSoleIsStopped) {
  ASSERT_TRUE(stance_.Lift(0, 0.05));
  for (int i = 0; i < 1200; ++i) Update();
  ASSERT_EQ(stance_.phase(0), ContactPhase::kUp);
  stance_.PutDown(0);
  // The foot follows its reference exactly.
  const FrameReference& target = reference_.feet[0];
  do {
    contacts_[0].X_WC = target.X_WF;
    contacts_[0].V_WC_C.tail<3>() = target.V_WF_W.tail<3>();
    Update();
    ASSERT_EQ(stance_.phase(0), ContactPhase::kLanding);
  } while (target.X_WF.p.z() > -1e-3);
  contacts_[0].V_WC_C.setZero();
  Update();
  EXPECT_EQ(stance_.phase(0), ContactPhase::kLoading);
}

TEST_F(StanceTest, LiftRightAfterReleaseUnloadsFirst) {
  contacts_[0].X_WC.p = Vector3d(1, 2, 0);
  stance_.LetGo(0);
  ASSERT_TRUE(stance_.Lift(0, 0.05));
  EXPECT_EQ(stance_.phase(0), ContactPhase::kUnloading);
  Update();
  EXPECT_TRUE(contacts_[0].in_contact);
  while (stance_.phase(0) != ContactPhase::kUp) Update();
  EXPECT_LT((reference_.feet[0].X_WF.p - Vector3d(1, 2, 0)).norm(), 1e-6);
}

// A falling foot that is high and far from its place must be above its place
// before it lands.
TEST_F(StanceTest, ReturnsFallingFootToItsPlaceBeforeLanding) {
  stance_.LetGo(0);
  Update();
  const Vector3d away(0.55, -0.15, 0.4);
  contacts_[0].X_WC.p = away;
  contacts_[0].V_WC_C.tail<3>() = Vector3d(-0.4, 1.3, -1.6);
  stance_.PutDown(0);
  const FrameReference& target = reference_.feet[0];
  double last = away.z();
  for (int i = 0; i < 500; ++i) {
    Update();
    const Vector3d& p = target.X_WF.p;
    EXPECT_LE(p.z(), last);
    if (p.head<2>().norm() > 1e-3) {
      EXPECT_GT(p.z(), 0.015);
    }
    last = p.z();
    if (i >= 350) {
      EXPECT_LT(p.head<2>().norm(), 1e-12);
      EXPECT_LT(target.V_WF_W.head<5>().norm(), 1e-12);
    }
  }
  EXPECT_NEAR(last, -0.005, 1e-12);
  EXPECT_EQ(stance_.phase(0), ContactPhase::kReturning);
}

TEST_F(StanceTest, PutDownRightAfterReleaseKeepsContact) {
  stance_.LetGo(0);
  stance_.PutDown(0);
  EXPECT_EQ(stance_.phase(0), ContactPhase::kDown);
  Update();
  EXPECT_TRUE(contacts_[0].in_contact);
}

// A foot that is released in the air does not become a contact, whatever phase
// it was in. It returns to the place where it took off.
TEST_F(StanceTest, KeepsFootInAirThatIsReleasedAndCalledBackAtOnce) {
  const auto lift = [this] {
    ASSERT_TRUE(stance_.Lift(0, 0.1));
    while (stance_.phase(0) != ContactPhase::kUp) Update();
  };
  const std::pair<ContactPhase, std::function<void()>> cases[] = {
      {ContactPhase::kUp, lift},
      {ContactPhase::kLanding,
       [&] {
         lift();
         stance_.PutDown(0);
       }},
      {ContactPhase::kLost,
       [this] {
         contacts_[0].X_WC.p.z() = 0.1;
         UpdateForLost();
       }},
      {ContactPhase::kFree,
       [this] {
         stance_.LetGo(0);
         Update();
       }},
      {ContactPhase::kStepping, [this] {
         stance_.Step(0);
         Update();
       }}};
  for (const auto& [phase, bring] : cases) {
    const Vector3d place(0.1 * static_cast<int>(phase), 2, 0);
    for (const double height : {0.0, 0.05}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(phase) << height);
      stance_.Reset();
      contacts_[0].X_WC.p = place;
      Update();
      bring();
      ASSERT_EQ(stance_.phase(0), phase);
      contacts_[0].X_WC.p = place + Vector3d(0.05, 0.02, 0.1);
      stance_.LetGo(0);
      stance_.LetGo(0);
      if (height > 0) {
        ASSERT_TRUE(stance_.Lift(0, height));
      } else {
        stance_.PutDown(0);
      }
      EXPECT_EQ(stance_.phase(0), ContactPhase::kReturning);
      for (int i = 0; i < 500; ++i) {
        Update();
        ASSERT_FALSE(contacts_[0].in_contact);
      }
      // The reference of a foot that is put down ends 5 mm below the ground.
      // The tolerance is for rounding of 500 steps: 500 eps of 2 m are 2e-13 m.
      const Vector3d end(0, 0, height > 0 ? height : -0.005);
      EXPECT_LT((reference_.feet[0].X_WF.p - place - end).norm(), 1e-9);
    }
  }
}

TEST_F(StanceTest, FadesForceOutBeforeLift) {
  ASSERT_TRUE(stance_.Lift(0, 0.05));
  Update();
  EXPECT_TRUE(contacts_[0].in_contact);
  EXPECT_FALSE(stance_.is_meant_down(0));
  double last = 200;
  for (int i = 0; i < 298; ++i) {
    Update();
    EXPECT_LT(contacts_[0].max_normal_force, last);
    last = contacts_[0].max_normal_force;
  }
  for (int i = 0; i < 3; ++i) Update();
  EXPECT_EQ(stance_.phase(0), ContactPhase::kUp);
  EXPECT_FALSE(contacts_[0].in_contact);
  FrameReference begun = reference_.feet[0];
  for (int i = 0; i <= 800; ++i) {
    Update();
    ExpectMovesAsItSays(begun, reference_.feet[0]);
    begun = reference_.feet[0];
  }
  EXPECT_NEAR(reference_.feet[0].X_WF.p.z(), 0.05, 1e-12);
  EXPECT_NEAR(reference_.feet[0].V_WF_W.norm(), 0, 1e-9);
  stance_.Reset();
  Update();
  EXPECT_TRUE(contacts_[0].in_contact);
}

TEST_F(StanceTest, FadesEachFootFromItsOwnForce) {
  ASSERT_TRUE(stance_.Lift(0, 0.05));
  ASSERT_TRUE(stance_.Lift(1, 0.05));
  Update();
  EXPECT_NEAR(contacts_[0].max_normal_force, 200 * (1 - 1 / 300.), 1e-9);
  EXPECT_NEAR(contacts_[1].max_normal_force, 100 * (1 - 1 / 300.), 1e-9);
}

// The floor has any height; the sole becomes level while it rises.
TEST_F(StanceTest, LiftsFootUprightFromItsPlace) {
  reference_.ground_z = 0.3;
  const Eigen::Matrix3d heading = ExpSo3(Vector3d(0, 0, 0.4));
  contacts_[0].X_WC = {heading * ExpSo3(Vector3d(0.02, -0.03, 0)),
                       Vector3d(1, 2, 0.3)};
  contacts_[1].X_WC.p.z() = 0.3;
  ASSERT_TRUE(stance_.Lift(0, 0.05));
  while (stance_.phase(0) != ContactPhase::kUp) Update();
  const Pose& target = reference_.feet[0].X_WF;
  EXPECT_LT((target.p - Vector3d(1, 2, 0.3)).norm(), 1e-6);
  // The tilts change the heading by half of their product.
  EXPECT_LT((target.R - heading).norm(), 1e-3);
  EXPECT_LT((target.R.col(2) - Vector3d::UnitZ()).norm(), 1e-12);
  for (int i = 0; i <= 800; ++i) Update();
  EXPECT_LT((target.p - Vector3d(1, 2, 0.35)).norm(), 1e-9);
}

TEST_F(StanceTest, LiftsToLastCommandedHeight) {
  ASSERT_TRUE(stance_.Lift(0, 0.05));
  Update();
  ASSERT_TRUE(stance_.Lift(0, 0.03));
  for (int i = 0; i < 301; ++i) Update();
  ASSERT_EQ(stance_.phase(0), ContactPhase::kUp);
  for (int i = 0; i < 400; ++i) Update();
  const double reached = reference_.feet[0].X_WF.p.z();
  EXPECT_GT(reached, 0.01);
  EXPECT_LT(reached, 0.02);
  ASSERT_TRUE(stance_.Lift(0, 0.08));
  Update();
  EXPECT_NEAR(reference_.feet[0].X_WF.p.z(), reached, 1e-6);  // No jump.
  for (int i = 0; i < 801; ++i) Update();
  EXPECT_NEAR(reference_.feet[0].X_WF.p.z(), 0.08, 1e-12);
}

TEST_F(StanceTest, LiftsLostFootFromPresentHeight) {
  Roll(0, 0.03);
  for (int i = 0; i < 80; ++i) Update();
  ASSERT_EQ(stance_.phase(0), ContactPhase::kLost);
  const double reached = reference_.feet[0].X_WF.p.z();
  EXPECT_LT(reached, 0.025);
  EXPECT_GT(reached, 0.01);  // The way is 35 mm, at 0.2 m/s.
  ASSERT_TRUE(stance_.Lift(0, 0.05));
  Update();
  EXPECT_EQ(stance_.phase(0), ContactPhase::kUp);
  EXPECT_FALSE(stance_.is_meant_down(0));
  EXPECT_NEAR(reference_.feet[0].X_WF.p.z(), reached, 1e-6);  // No jump.
}

TEST_F(StanceTest, PutsFootDown) {
  stance_.PutDown(0);
  EXPECT_EQ(stance_.phase(0), ContactPhase::kDown);  // No effect.
  ASSERT_TRUE(stance_.Lift(0, 0.05));
  Update();
  stance_.PutDown(0);
  Update();
  EXPECT_EQ(stance_.phase(0), ContactPhase::kLoading);
  // The bound starts at the weight of the robot: the foot still carries load.
  EXPECT_GE(contacts_[0].max_normal_force, 400);
  ASSERT_TRUE(stance_.Lift(0, 0.05));
  for (int i = 0; i < 1200; ++i) Update();
  ASSERT_EQ(stance_.phase(0), ContactPhase::kUp);
  stance_.PutDown(0);
  EXPECT_EQ(stance_.phase(0), ContactPhase::kLanding);
  double last = 0.06;
  for (int i = 0; i < 799; ++i) {
    // The foot follows its reference.
    contacts_[0].X_WC.p.z() = last;
    Update();
    if (stance_.phase(0) != ContactPhase::kLanding) break;
    EXPECT_LE(reference_.feet[0].X_WF.p.z(), last);
    last = reference_.feet[0].X_WF.p.z();
  }
  EXPECT_EQ(stance_.phase(0), ContactPhase::kLoading);
  EXPECT_TRUE(contacts_[0].in_contact);
  EXPECT_LT(last, 0.005);
}

// An invalid height in the references would make every tick fail safe.
TEST_F(StanceTest, RejectsInvalidHeight) {
  for (const double height :
       {std::nan(""), HUGE_VAL, -HUGE_VAL, -0.05, 0.0, 1.1}) {
    EXPECT_FALSE(stance_.Lift(0, height)) << height;
    EXPECT_EQ(stance_.phase(0), ContactPhase::kDown);
  }
  stance_.LetGo(0);
  Update();
  EXPECT_FALSE(stance_.Lift(0, std::nan("")));
  EXPECT_EQ(stance_.phase(0), ContactPhase::kFree);
}

TEST_F(StanceTest, RejectsInvalidSettings) {
  double StanceSettings::*const members[] = {
      &StanceSettings::fade_time,   &StanceSettings::swing_time,
      &StanceSettings::return_time, &StanceSettings::lost_above,
      &StanceSettings::lost_after,  &StanceSettings::found_below};
  for (double StanceSettings::*const member : members) {
    for (const double bad : {-1e-3, 61.0, std::nan(""), HUGE_VAL}) {
      SCOPED_TRACE(bad);
      StanceSettings settings;
      settings.*member = bad;
      EXPECT_THROW(stance_.Configure(settings), std::invalid_argument);
    }
  }
  EXPECT_EQ(stance_.settings().fade_time, 0.3);
  StanceSettings settings;
  settings.fade_time = -1;
  try {
    stance_.Configure(settings);
    FAIL() << "Configure() accepted a negative time";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "stance: fade_time is -1 s, must be 0 to 60 s");
  }
}

// Times of 0 must not cause a division 0/0.
TEST_F(StanceTest, TimesOfZeroActAtOnce) {
  StanceSettings at_once;
  at_once.fade_time = at_once.swing_time = 0;
  at_once.return_time = at_once.lost_after = 0;
  stance_.Configure(at_once);
  const FrameReference& target = reference_.feet[0];
  const auto update = [&](ContactPhase phase) {
    Update();
    EXPECT_EQ(stance_.phase(0), phase);
    EXPECT_FALSE(std::isnan(contacts_[0].max_normal_force));
    EXPECT_TRUE(target.X_WF.p.allFinite() && target.X_WF.R.allFinite());
    EXPECT_TRUE(target.V_WF_W.allFinite() && target.A_WF_W.allFinite());
  };
  update(ContactPhase::kDown);
  ASSERT_TRUE(stance_.Lift(0, 0.05));
  update(ContactPhase::kUp);
  update(ContactPhase::kUp);
  EXPECT_NEAR(target.X_WF.p.z(), 0.05, 1e-12);
  contacts_[0].X_WC.p.z() = 0.05;
  stance_.PutDown(0);
  update(ContactPhase::kLanding);
  EXPECT_NEAR(target.X_WF.p.z(), 0,
              1e-8);  // The reference sinks for one more tick.
  contacts_[0].X_WC.p.z() = 0;
  for (int i = 0; i < 1000 && !contacts_[0].in_contact; ++i) Update();
  update(ContactPhase::kDown);
  stance_.LetGo(0);
  update(ContactPhase::kFree);
  contacts_[0].X_WC.p.z() = 0.05;
  stance_.PutDown(0);
  update(ContactPhase::kReturning);
  EXPECT_NEAR(target.X_WF.p.z(), -0.005, 1e-12);
}

TEST(MidFeet, IsLevelAtMeanOfFeetInContact) {
  const auto turn = [](double yaw, double pitch) {
    return Eigen::Matrix3d(ExpSo3(Vector3d(0, 0, yaw)) *
                           ExpSo3(Vector3d(0, pitch, 0)));
  };
  std::vector<ContactTick> contacts(2);
  contacts[0].X_WC = {turn(0.2, 0.3), Vector3d(1, 2, 0.1)};
  contacts[1].X_WC = {turn(0.6, -0.1), Vector3d(3, 6, 0.3)};
  const double heading =
      std::atan2(std::cos(0.3) * std::sin(0.2) + std::cos(0.1) * std::sin(0.6),
                 std::cos(0.3) * std::cos(0.2) + std::cos(0.1) * std::cos(0.6));
  for (const bool all : {true, false}) {  // Without contact, all feet count.
    contacts[0].in_contact = contacts[1].in_contact = all;
    const Pose X_WMid = MidFeet(contacts);
    EXPECT_LT((X_WMid.p - Vector3d(2, 4, 0.2)).norm(), 1e-12);
    EXPECT_LT((X_WMid.R - turn(heading, 0)).norm(), 1e-12);
  }
  contacts[1].in_contact = true;
  const Pose X_WMid = MidFeet(contacts);
  EXPECT_LT((X_WMid.p - contacts[1].X_WC.p).norm(), 1e-12);
  EXPECT_LT((X_WMid.R - turn(0.6, 0)).norm(), 1e-12);
  contacts[1].X_WC.R = turn(0.6, -M_PI / 2);  // Sole vertical: no heading.
  EXPECT_TRUE(MidFeet(contacts).R.isIdentity(0));
}

// A step leaves the ground at once, without a fading force, and follows the
// path that the caller writes.
TEST_F(StanceTest, StepLeavesAtOnceAndKeepsThePathOfTheCaller) {
  Update();
  stance_.Step(0);
  reference_.feet[0].X_WF.p = Vector3d(0.3, 0.2, 0.05);
  Update();
  EXPECT_EQ(stance_.phase(0), ContactPhase::kStepping);
  EXPECT_FALSE(contacts_[0].in_contact);
  EXPECT_TRUE(contacts_[0].is_stepping);
  EXPECT_TRUE(contacts_[0].is_guided);
  EXPECT_FALSE(stance_.is_meant_down(0));
  EXPECT_EQ(reference_.feet[0].X_WF.p, Vector3d(0.3, 0.2, 0.05));
  EXPECT_TRUE(contacts_[1].in_contact);
}

// A step lands with full force when the sole lies on the ground, but not before
// it has risen, and not while it rises.
TEST_F(StanceTest, StepLandsWithItsSoleOnTheGround) {
  stance_.Step(0);
  for (int i = 0; i < 20; ++i) Update();
  EXPECT_EQ(stance_.phase(0), ContactPhase::kStepping);
  contacts_[0].X_WC.p.z() = 0.02;
  Update();
  contacts_[0].X_WC.p.z() = 0.0005;
  contacts_[0].V_WC_C[5] = 0.3;
  Update();
  EXPECT_EQ(stance_.phase(0), ContactPhase::kStepping);
  contacts_[0].V_WC_C[5] = -0.3;
  Update();
  EXPECT_EQ(stance_.phase(0), ContactPhase::kDown);
  EXPECT_TRUE(contacts_[0].in_contact);
  EXPECT_FALSE(contacts_[0].is_stepping);
  EXPECT_TRUE(std::isinf(contacts_[0].max_normal_force));
}

// The ground is 1 cm higher than believed: the sole stops while its path sinks.
TEST_F(StanceTest, StepLandsOnGroundThatIsHigherThanBelieved) {
  stance_.Step(0);
  contacts_[0].X_WC.p.z() = 0.04;
  Update();
  contacts_[0].X_WC.p.z() = 0.01;
  for (const double sinking : {0.0, 0.3}) {
    reference_.feet[0].V_WF_W[5] = -sinking;
    for (int i = 0; i < 10; ++i) Update();
    EXPECT_EQ(stance_.phase(0) == ContactPhase::kDown, sinking > 0);
  }
}

// Lift() and PutDown() end a step: the foot moves from its present pose to the
// place where it took off, or above it.
TEST_F(StanceTest, CallsSteppingFootBack) {
  const Pose away{ExpSo3(Vector3d(0.4, -0.2, 0.1)), Vector3d(1.2, 2.1, 0.1)};
  for (const double height : {0.0, 0.05}) {
    SCOPED_TRACE(height);
    stance_.Reset();
    contacts_[0].X_WC = {Eigen::Matrix3d::Identity(), Vector3d(1, 2, 0)};
    Update();
    stance_.Step(0);
    Update();
    contacts_[0].X_WC = away;
    Update();
    if (height > 0) {
      ASSERT_TRUE(stance_.Lift(0, height));
    } else {
      stance_.PutDown(0);
    }
    EXPECT_EQ(stance_.phase(0), ContactPhase::kReturning);
    const Pose& target = reference_.feet[0].X_WF;
    Update();
    EXPECT_FALSE(contacts_[0].in_contact);
    EXPECT_FALSE(contacts_[0].is_stepping);
    // Tolerance: the minimum-jerk curve moves by 1e-7 of its length in 1 ms.
    EXPECT_LT((target.p - away.p).norm(), 1e-6);
    EXPECT_LT((target.R - away.R).norm(), 1e-6);
    for (int i = 0; i < 500; ++i) Update();
    // The tolerance is for rounding of 500 steps, as above.
    const Vector3d end(1, 2, height > 0 ? height : -0.005);
    EXPECT_LT((target.p - end).norm(), 1e-9);
    EXPECT_LT((target.R - Eigen::Matrix3d::Identity()).norm(), 1e-9);
  }
}

TEST_F(StanceTest, PutDownRightAfterStepKeepsContact) {
  stance_.Step(0);
  stance_.PutDown(0);
  EXPECT_EQ(stance_.phase(0), ContactPhase::kDown);
  stance_.Step(0);
  ASSERT_TRUE(stance_.Lift(0, 0.05));
  EXPECT_EQ(stance_.phase(0), ContactPhase::kUnloading);
}

}  // namespace
}  // namespace poise
