// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests the tasks during pushes that move the capture point to the edge of the
// soles.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/hqp/hierarchy.h"
#include "poise/math/so3.h"
#include "poise/robot/control/balance_monitor.h"
#include "poise/robot/control/contacts.h"
#include "poise/robot/control/reference.h"
#include "poise/robot/control/task.h"
#include "poise/robot/control/tasks/capture_point.h"
#include "poise/robot/control/tasks/cop.h"
#include "poise/robot/control/tasks/momentum.h"
#include "poise/robot/control/tasks/posture.h"
#include "poise/robot/control/tasks/support_box.h"
#include "poise/robot/control/tasks/task_fixture.h"
#include "poise/tests/util/decompositions.h"

namespace poise {
namespace {

TEST_F(TaskTest, SupportBoxContainsTheCorners) {
  std::vector<ContactTick> contacts = controller_.contacts();
  contacts[0].X_WC.p << 0.02, 0.1, 0;
  contacts[1].X_WC.p << -0.03, -0.2, 0;
  contacts[0].X_WC.R = ExpSo3({0, 0, 0.3});
  contacts[1].X_WC.R = ExpSo3({0, 0, -2});
  for (const bool both : {true, false}) {
    contacts[1].in_contact = both;
    Eigen::Vector2d most(-1, -1), least(1, 1);
    for (int i = 0; i < (both ? 2 : 1); ++i) {
      for (const double x : {1.0, -1.0}) {
        for (const double y : {1.0, -1.0}) {
          const Eigen::Vector3d corner =
              contacts[i].X_WC *
              Eigen::Vector3d(x * half_.x(), y * half_.y(), 0);
          most = most.cwiseMax(corner.head<2>());
          least = least.cwiseMin(corner.head<2>());
        }
      }
    }
    const auto reach = [&](SupportSide side) {
      return SupportReach(robot_.feet, contacts, Pose(), side);
    };
    EXPECT_NEAR(reach(kFront), most.x(), 1e-12);
    EXPECT_NEAR(reach(kBack), -least.x(), 1e-12);
    EXPECT_NEAR(reach(kLeft), most.y(), 1e-12);
    EXPECT_NEAR(reach(kRight), -least.y(), 1e-12);
  }
}

TEST_F(TaskTest, UsesTheCopMarginAndTheArmsInLargePushes) {
  const auto write = [this](const Task& task, double capture) {
    const int equalities = static_cast<int>(task.equality_names().size());
    const int inequalities = static_cast<int>(task.inequality_names().size());
    hierarchy_ = Hierarchy(nv_ + 12, {{equalities, inequalities}});
    hierarchy_.Clear(1);
    EqualityBlock equal = hierarchy_.AddEqualities(0, equalities);
    InequalityBlock unequal = hierarchy_.AddInequalities(0, inequalities);
    TaskInput now = input();
    now.capture = capture;
    task.Write(now, &equal, &unequal);
  };
  const CopTask cop(tree_, robot_.feet);
  const PostureTask posture(robot_.model);
  const int chest = *tree_.FindJoint("chest_pitch");
  const double M =
      controller_.tick().M(tree_.v_start() + chest, tree_.v_start() + chest);
  for (const double capture : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    write(cop, capture);
    const double margin = 0.005 - 0.004 * std::max(0.0, 2 * capture - 1);
    const double scale = 4 / (9.81 * tree_.total_mass());
    EXPECT_NEAR(hierarchy_.C(0)(0, nv_ + 5), -scale * (half_.x() - margin),
                1e-15);
    EXPECT_NEAR(hierarchy_.C(0)(2, nv_ + 5), -scale * (half_.y() - margin),
                1e-15);
    write(posture, capture);
    EXPECT_NEAR(hierarchy_.weight(0)[chest], std::pow(M, 0.5 + 0.5 * capture),
                1e-12);
  }
}

// Reads the capture blend, 0 to 1, of the momentum task after a velocity change
// of the center of mass along u, m/s, and checks it against the gains.
class CaptureTest : public TaskTest {
 protected:
  CaptureTest() { state_.v.setZero(); }

  double Share(const Vector6d& momentum_over_mass) {
    // A motion of all joints with this momentum.
    const Tick& rest = controller_.tick();
    const Eigen::MatrixXd H = rest.H_G / tree_.total_mass();
    state_.v = LeastSquaresSolution(H, momentum_over_mass).x;
    ComputeTick(tree_, state_.q, state_.v, &tick_);
    hierarchy_ = Hierarchy(nv_ + 12, {{6, 0}});
    hierarchy_.Clear(1);
    EqualityBlock rows = hierarchy_.AddEqualities(0, 6);
    InequalityBlock none = hierarchy_.AddInequalities(0, 0);
    TaskInput now{state_, tick_, controller_.contacts(),
                  controller_.reference(), unmodelled_vdot_};
    monitor_.Update(tick_, now.contacts, now.reference,
                    task_.capture_settings(), Eigen::Vector2d(1, 1));
    const Balance& balance = monitor_.balance();
    left_ = balance.left;
    right_ = balance.right;
    now.capture = balance.capture;
    task_.Write(now, &rows, &none);
    // b = bias - desired; only -kd v_G of the desired value is not zero.
    const Eigen::Vector3d v = momentum_over_mass.tail<3>();
    const Eigen::Vector3d wanted =
        tick_.H_G_bias.tail<3>() / tree_.total_mass() - rows.b.tail<3>();
    EXPECT_NEAR(wanted.z(), -10 * v.z(), 1e-6);
    const double share = now.capture;
    for (const int row : {0, 1, 2, 5}) {
      EXPECT_NEAR(rows.weight[row], std::pow(0.3, share), 1e-12);
    }
    EXPECT_EQ(rows.weight[3], 1);
    EXPECT_EQ(rows.weight[4], 1);
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(wanted[axis], -(10 + 20 * share) * v[axis], 1e-6);
    }
    return share;
  }

  // Returns the velocity that moves the capture point so far along an axis.
  Vector6d Fast(int axis, double way) const {
    Vector6d momentum = Vector6d::Zero();
    momentum[3 + axis] = way * w_;
    return momentum;
  }

  MomentumTask task_{tree_, robot_.feet};
  BalanceMonitor monitor_{tree_, robot_.feet};
  Tick tick_{tree_, {}};
  double left_ = 0, right_ = 0;  // From the last Share().
  const double height_ = controller_.tick().p_WG.z();
  const double w_ = std::sqrt(9.81 / height_);
  const double front_ = half_.x();
  const double edge_ = controller_.contacts()[0].X_WC.p.y() + half_.y();
};

TEST_F(CaptureTest, BlendsFromShortOfTheEdgeToTheEdge) {
  for (const double side : {1.0, -1.0}) {
    EXPECT_EQ(Share(Fast(0, 0.64 * side * front_)), 0);
    EXPECT_NEAR(Share(Fast(0, 0.825 * side * front_)), 0.5, 0.01);
    EXPECT_NEAR(Share(Fast(0, 1.1 * side * front_)), 1, 1e-12);
    EXPECT_EQ(left_ + right_, 0);
    // Sideways the blend begins 25 % farther out.
    EXPECT_EQ(Share(Fast(1, 0.8 * side * edge_)), 0);
    EXPECT_NEAR(Share(Fast(1, 1.031 * side * edge_)), 0.5, 0.01);
    EXPECT_NEAR(side > 0 ? left_ : right_, 0.5, 0.01);
    EXPECT_EQ(side > 0 ? right_ : left_, 0);
    EXPECT_NEAR(Share(Fast(1, 1.3 * side * edge_)), 1, 1e-12);
  }
  for (const Parameter& each : task_.parameters()) {
    if (each.name == "capture") *each.value = 0;
  }
  EXPECT_EQ(Share(Fast(0, 1.1 * front_)), 0);
}

TEST_F(CaptureTest, IncludesAngularMomentumInTheCapturePoint) {
  // Bending forward at this rate: stopping it moves the capture point so far.
  // Bending to the left is about -x.
  Vector6d forward = Vector6d::Zero(), left = Vector6d::Zero();
  forward[1] = 0.825 * front_ * w_ * height_;
  left[0] = -1.031 * edge_ * w_ * height_;
  EXPECT_NEAR(Share(forward), 0.5, 0.01);
  EXPECT_NEAR(Share(left), 0.5, 0.01);
  // Forward motion and backward bending cancel.
  EXPECT_EQ(Share(Fast(0, 0.825 * front_) - forward), 0);
}

// The target is the middle half of the sole in contact, or the reference if it
// is inside.
TEST_F(CaptureTest, MovesTheTargetOverTheRemainingFoot) {
  std::vector<ContactTick> contacts = controller_.contacts();
  Reference reference = controller_.reference();
  const auto pull = [&](const Eigen::Vector2d& at) {
    reference.p_WG.head<2>() = at;
    hierarchy_ = Hierarchy(nv_ + 12, {{6, 0}});
    hierarchy_.Clear(1);
    EqualityBlock rows = hierarchy_.AddEqualities(0, 6);
    InequalityBlock none = hierarchy_.AddInequalities(0, 0);
    task_.Write(
        {state_, controller_.tick(), contacts, reference, unmodelled_vdot_},
        &rows, &none);
    const Vector6d wanted =
        controller_.tick().H_G_bias / tree_.total_mass() - rows.b;
    return Eigen::Vector2d(
        (wanted.segment<2>(3) + 10 * controller_.tick().v_WG.head<2>()) / 30 +
        controller_.tick().p_WG.head<2>());
  };
  const Eigen::Vector2d foot = contacts[0].X_WC.p.head<2>();
  const Eigen::Vector2d there = foot + Eigen::Vector2d(0.01, -0.02);
  EXPECT_LT((pull({0.5, -0.3}) - Eigen::Vector2d(0.5, -0.3)).norm(), 1e-9);
  contacts[1].in_contact = false;
  EXPECT_LT((pull(there) - there).norm(), 1e-9);
  for (const double x : {1.0, -1.0}) {
    for (const double y : {1.0, -1.0}) {
      const Eigen::Vector2d corner =
          foot + 0.5 * Eigen::Vector2d(x * half_.x(), y * half_.y());
      EXPECT_LT((pull({x, y}) - corner).norm(), 1e-6);
    }
  }
  contacts[0].in_contact = false;  // No foot in contact: the reference.
  EXPECT_LT((pull(there) - there).norm(), 1e-9);
}

TEST_F(CaptureTest, IncludesTheVelocityOfTheReference) {
  controller_.reference().v_WG.x() = 0.5 * front_ * w_;
  EXPECT_NEAR(Share(Fast(0, (0.5 + 0.4125) * front_)), 0.5, 0.02);
}

// The way to the edge counts as at least 1 cm; 8.25 mm of it are covered.
TEST_F(CaptureTest, HandlesAReferenceBeyondTheEdge) {
  controller_.reference().p_WG.x() += front_ + 0.02;
  for (const Parameter& each : task_.parameters()) {
    if (each.name == "kp" || each.name == "capture_kp") *each.value = 0;
  }
  EXPECT_NEAR(Share(Fast(0, front_ + 0.02 + 0.00825)), 0.5, 0.02);
}

TEST_F(CaptureTest, HandlesAReferenceNearTheEdge) {
  // Half of the way remains, and 82.5 % of it are covered.
  controller_.reference().p_WG.x() += 0.5 * front_;
  for (const Parameter& each : task_.parameters()) {
    if (each.name == "kp" || each.name == "capture_kp") *each.value = 0;
  }
  EXPECT_NEAR(Share(Fast(0, (0.5 + 0.4125) * front_)), 0.5, 0.02);
}

TEST_F(TaskTest, CapturePointStopsShortOfTheEdge) {
  const CapturePointTask task(tree_, robot_.feet);
  // With the largest acceleration that the row of the left side allows, the
  // capture point approaches the bound with the time constant of the horizon.
  const Eigen::Vector3d p = controller_.tick().p_WG;
  const Eigen::Vector3d v = controller_.tick().v_WG;
  const double w = std::sqrt(9.81 / p.z());
  const double edge = controller_.contacts()[0].X_WC.p.y() + half_.y() - 0.02;
  const Hierarchy& rows = Write(task);
  const Eigen::VectorXd y = RandomY();
  const Tick& tick = controller_.tick();
  const double a = (tick.H_G.row(4).dot(y.head(nv_)) + tick.H_G_bias[4]) /
                   tree_.total_mass();
  const double xi = p.y() + v.y() / w, rate = v.y() + a / w;
  EXPECT_NEAR(rows.C(0).row(2).dot(y) - rows.upper(0)[2],
              xi + 0.1 * rate - edge, 1e-6);
  EXPECT_NEAR(rows.C(0).row(3).dot(y) - rows.upper(0)[3],
              -xi - 0.1 * rate - edge, 1e-6);
  const double a_x = (tick.H_G.row(3).dot(y.head(nv_)) + tick.H_G_bias[3]) /
                     tree_.total_mass();
  const double ahead = p.x() - controller_.contacts()[0].X_WC.p.x() +
                       v.x() / w + 0.1 * (v.x() + a_x / w);
  const double front = half_.x() - 0.02;
  EXPECT_NEAR(rows.C(0).row(0).dot(y) - rows.upper(0)[0], ahead - front, 1e-6);
  EXPECT_NEAR(rows.C(0).row(1).dot(y) - rows.upper(0)[1], -ahead - front, 1e-6);
}

}  // namespace
}  // namespace poise
