// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests the rows on the wrench of a foot with forces that a sole can and cannot
// transmit.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/robot/control/contacts.h"
#include "poise/robot/control/task.h"
#include "poise/robot/control/tasks/cop.h"
#include "poise/robot/control/tasks/force_regularizer.h"
#include "poise/robot/control/tasks/friction.h"
#include "poise/robot/control/tasks/task_fixture.h"
#include "poise/robot/control/tasks/unilateral.h"
#include "poise/robot/control/tasks/yaw.h"
#include "poise/robot/control/tasks/yaw_constant.h"
#include "poise/robot/control/tasks/zmp.h"
#include "poise/robot/control/tasks/zmp_literal.h"

namespace poise {
namespace {

class FootWrenchTest : public TaskTest {
 protected:
  // Returns the largest violation of a row; negative: the smallest gap.
  double Violation(const Task& task, const Eigen::VectorXd& y) {
    const Hierarchy& rows = Write(task);
    const Eigen::VectorXd value = rows.C(0) * y;
    return std::max((value - rows.upper(0)).maxCoeff(),
                    (rows.lower(0) - value).maxCoeff());
  }

  // Violation() if foot 0 may use only a share of its sole and friction.
  double Violation(const Task& task, double share, const Eigen::VectorXd& y) {
    std::vector<ContactTick> contacts = controller_.contacts();
    contacts[0].wrench_share = share;
    const int rows = static_cast<int>(task.inequality_names().size());
    hierarchy_ = Hierarchy(nv_ + 12, {{0, rows}});
    hierarchy_.Clear(1);
    EqualityBlock none = hierarchy_.AddEqualities(0, 0);
    InequalityBlock bounded = hierarchy_.AddInequalities(0, rows);
    task.Write({state_, controller_.tick(), contacts, controller_.reference(),
                unmodelled_vdot_},
               &none, &bounded);
    return (hierarchy_.C(0) * y - hierarchy_.upper(0)).maxCoeff();
  }

  // Returns y with a force f at a point of the sole of foot 0, in C's axes.
  Eigen::VectorXd Loaded(const Eigen::Vector2d& at, const Eigen::Vector3d& f) {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(nv_ + 12);
    const Eigen::Vector3d p(at.x(), at.y(), 0);
    y.segment<6>(nv_) << p.cross(f), f;
    return y;
  }
};

TEST_F(FootWrenchTest, CopRowsHoldForForcesOnTheSole) {
  const CopTask cop(tree_, robot_.feet);
  const double x = half_.x() - 0.005, y = half_.y() - 0.005;
  const Eigen::Vector3d f(20, -10, 300);
  EXPECT_LE(Violation(cop, Loaded({0.99 * x, 0.99 * y}, f)), 0);
  EXPECT_LE(Violation(cop, Loaded({-0.99 * x, -0.99 * y}, f)), 0);
  for (const Eigen::Vector2d& at :
       {Eigen::Vector2d(1.01 * x, 0), Eigen::Vector2d(-1.01 * x, 0),
        Eigen::Vector2d(0, 1.01 * y), Eigen::Vector2d(0, -1.01 * y)}) {
    EXPECT_GT(Violation(cop, Loaded(at, f)), 0) << at.transpose();
  }
}

TEST_F(FootWrenchTest, CopRowsAreNamedForTheirEdges) {
  const CopTask cop(tree_, robot_.feet);
  const char* edges[] = {"x_max", "x_min", "y_max", "y_min"};
  const Eigen::Vector2d at[] = {{0.2, 0}, {-0.2, 0}, {0, 0.2}, {0, -0.2}};
  for (int i = 0; i < 4; ++i) {
    const Hierarchy& rows = Write(cop);
    const Eigen::VectorXd value =
        rows.C(0) * Loaded(at[i], Eigen::Vector3d(0, 0, 100));
    for (int row = 0; row < 4; ++row) {
      EXPECT_EQ(value[row] > 0, row == i) << edges[i];
    }
    EXPECT_EQ(cop.inequality_names()[i],
              std::string("left_foot.cop.") + edges[i]);
  }
}

TEST_F(FootWrenchTest, FrictionPyramidsTouchTheConeOutsideAndInside) {
  FrictionTask friction(tree_, robot_.feet);
  const double mu = 0.5, fz = 200;
  const auto pulled = [&](double share, double angle) {
    return Violation(
        friction,
        Loaded({0, 0}, Eigen::Vector3d(share * mu * fz * std::cos(angle),
                                       share * mu * fz * std::sin(angle), fz)));
  };
  for (const double axis : {0.0, 0.5, 1.0, 1.5}) {
    const double along = axis * 3.14159265358979, diagonal = along + 0.78539816;
    EXPECT_LE(pulled(0.99, along), 0);
    EXPECT_GT(pulled(1.01, along), 0);
    EXPECT_LE(pulled(1.40, diagonal), 0);
    EXPECT_GT(pulled(1.42, diagonal), 0);
  }
  *friction.parameters()[1].value = 1;
  for (const double axis : {0.0, 0.5, 1.0, 1.5}) {
    const double along = axis * 3.14159265358979, diagonal = along + 0.78539816;
    EXPECT_LE(pulled(0.70, along), 0);
    EXPECT_GT(pulled(0.72, along), 0);
    EXPECT_LE(pulled(0.99, diagonal), 0);
    EXPECT_GT(pulled(1.01, diagonal), 0);
  }
}

// A rectangular sole can transmit four corner forces inside their pyramids.
// Their wrench satisfies all rows of the cone, and extreme cases satisfy one
// with equality.
TEST_F(FootWrenchTest, YawConeAcceptsCornerForces) {
  const YawTask yaw(tree_, robot_.feet);
  const double mu = 0.5;
  double closest = -1e9;
  for (int trial = 0; trial < 500; ++trial) {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(nv_ + 12);
    const bool extreme = trial % 2 == 0;
    const double spin = trial % 4 == 0 ? 1 : -1;
    for (const int sx : {-1, 1}) {
      for (const int sy : {-1, 1}) {
        const double fz = Uniform(0, 100);
        // Extreme case: all corners push in the same sense of rotation.
        const double fx =
            extreme ? -spin * sy * mu * fz : Uniform(-mu, mu) * fz;
        const double fy = extreme ? spin * sx * mu * fz : Uniform(-mu, mu) * fz;
        y += Loaded({sx * half_.x(), sy * half_.y()},
                    Eigen::Vector3d(fx, fy, fz));
      }
    }
    const double violation = Violation(yaw, y);
    EXPECT_LT(violation, 1e-12);
    if (extreme) closest = std::max(closest, violation);
  }
  EXPECT_NEAR(closest, 0, 1e-12);
}

TEST_F(FootWrenchTest, YawConeRejectsMoreThanFriction) {
  const YawTask yaw(tree_, robot_.feet);
  const double most = 0.5 * (half_.x() + half_.y()) * 100;
  for (const double sign : {1.0, -1.0}) {
    Eigen::VectorXd y = Loaded({0, 0}, Eigen::Vector3d(0, 0, 100));
    y[nv_ + 2] = sign * 0.99 * most;
    EXPECT_LE(Violation(yaw, y), 0);
    y[nv_ + 2] = sign * 1.01 * most;
    EXPECT_GT(Violation(yaw, y), 0);
  }
}

TEST_F(FootWrenchTest, YawConstantIsProportionalToTheLoad) {
  const YawConstantTask yaw(tree_, robot_.feet);
  for (const double sign : {1.0, -1.0}) {
    Eigen::VectorXd y = Loaded({0, 0}, Eigen::Vector3d(0, 0, 100));
    y[nv_ + 2] = sign * 4.9;
    EXPECT_LE(Violation(yaw, y), 0);
    y[nv_ + 2] = sign * 5.1;
    EXPECT_GT(Violation(yaw, y), 0);
  }
}

TEST_F(FootWrenchTest, GroundDoesNotPull) {
  const UnilateralTask unilateral(tree_, robot_.feet);
  std::vector<ContactTick> contacts = controller_.contacts();
  contacts[0].max_normal_force = 30;  // The contact fades.
  hierarchy_ = Hierarchy(nv_ + 12, {{0, 2}});
  hierarchy_.Clear(1);
  EqualityBlock none = hierarchy_.AddEqualities(0, 0);
  InequalityBlock rows = hierarchy_.AddInequalities(0, 2);
  unilateral.Write({state_, controller_.tick(), contacts,
                    controller_.reference(), unmodelled_vdot_},
                   &none, &rows);
  EXPECT_NEAR(rows.upper[0] / rows.C(0, nv_ + 5), 30, 1e-9);
  EXPECT_EQ(rows.lower[0], 0);
  EXPECT_LE(Violation(unilateral, Loaded({0, 0}, {0, 0, 1})), 0);
  EXPECT_GT(Violation(unilateral, Loaded({0, 0}, {0, 0, -1})), 0);
}

TEST_F(FootWrenchTest, ZmpIsTheCopOfBothFeetInTheirMiddle) {
  const ZmpTask zmp(tree_, robot_.feet);
  const double foot_y = controller_.contacts()[0].X_WC.p.y();
  // The left foot carries all weight, at 0.099 and 0.101 m from the middle.
  const Eigen::Vector3d f(0, 0, 300);
  EXPECT_LE(Violation(zmp, Loaded({0, 0.099 - foot_y}, f)), 0);
  EXPECT_GT(Violation(zmp, Loaded({0, 0.101 - foot_y}, f)), 0);
  EXPECT_LE(Violation(zmp, Loaded({0.99 * half_.x(), 0}, f)), 0);
  EXPECT_GT(Violation(zmp, Loaded({1.01 * half_.x(), 0}, f)), 0);
  EXPECT_GT(Violation(zmp, Loaded({-1.01 * half_.x(), 0}, f)), 0);
}

TEST_F(FootWrenchTest, ZmpLiteralLetsFeetCancel) {
  const ZmpLiteralTask literal(tree_, robot_.feet);
  Eigen::VectorXd y = Loaded({0.3, 0}, Eigen::Vector3d(0, 0, 100));
  EXPECT_GT(Violation(literal, y), 0);
  y.tail<6>() = Loaded({-0.3, 0}, Eigen::Vector3d(0, 0, 100)).segment<6>(nv_);
  EXPECT_LE(Violation(literal, y), 0);
  y = Loaded({0, 0.3}, Eigen::Vector3d(0, 0, 100));
  EXPECT_GT(Violation(literal, y), 0);
  y = Loaded({0, -0.3}, Eigen::Vector3d(0, 0, 100));
  EXPECT_GT(Violation(literal, y), 0);
  // Tests each side of the box by itself.
  const Eigen::Vector3d up(0, 0, 100);
  for (const Eigen::Vector2d& side :
       {Eigen::Vector2d(half_.x(), 0), Eigen::Vector2d(-half_.x(), 0),
        Eigen::Vector2d(0, half_.y()), Eigen::Vector2d(0, -half_.y())}) {
    EXPECT_LE(Violation(literal, Loaded(0.99 * side, up)), 0);
    EXPECT_GT(Violation(literal, Loaded(1.01 * side, up)), 0);
  }
}

TEST_F(FootWrenchTest, ForceRegularizerIsTheForceItself) {
  const Eigen::VectorXd y = RandomY();
  const double scale = tree_.total_mass() * 9.81 / 4;
  const ForceRegularizerTask task(tree_, robot_.feet);
  const Eigen::VectorXd residual = Residual(task, y);
  EXPECT_LT((residual - y.tail<12>() / scale).norm(), 1e-12);
  EXPECT_NEAR(task.equality_scale(0), scale, 1e-12 * scale);
}

// Half of the sole and half of the friction: a corner of this smaller sole
// transmits a force on the edge of its friction, and no force beyond.
TEST_F(FootWrenchTest, WrenchShareShrinksSoleAndFriction) {
  const CopTask cop(tree_, robot_.feet);
  const FrictionTask friction(tree_, robot_.feet);
  const YawTask yaw(tree_, robot_.feet);
  const double fz = 200, most = 0.5 * 0.5 * fz;
  const Eigen::Vector2d corner = 0.5 * (half_.array() - 0.005).matrix();
  for (const double beyond : {0.99, 1.01}) {
    SCOPED_TRACE(beyond);
    const bool is_beyond = beyond > 1;
    EXPECT_EQ(Violation(cop, 0.5, Loaded(beyond * corner, {0, 0, fz})) > 0,
              is_beyond);
    EXPECT_EQ(
        Violation(friction, 0.5, Loaded({0, 0}, {beyond * most, 0, fz})) > 0,
        is_beyond);
    Eigen::VectorXd turned = Loaded({0, 0}, {0, 0, fz});
    turned[nv_ + 2] = beyond * 0.5 * (half_.x() + half_.y()) * most;
    EXPECT_EQ(Violation(yaw, 0.5, turned) > 0, is_beyond);
    EXPECT_LE(Violation(yaw, 1, turned), 0);
  }
}

// During a step, friction and yaw moment keep a reserve.
TEST_F(FootWrenchTest, FrictionAndYawKeepAReserveDuringAStep) {
  const FrictionTask friction(tree_, robot_.feet);
  const YawTask yaw(tree_, robot_.feet);
  const double mu = 0.5, fz = 200;
  const auto pulled = Loaded({0, 0}, Eigen::Vector3d(0.9 * mu * fz, 0, fz));
  const double moment = 0.8 * mu * (half_.x() + half_.y()) * fz;
  Eigen::VectorXd turned = Loaded({0, 0}, Eigen::Vector3d(0, 0, fz));
  turned[nv_ + 2] = moment;
  EXPECT_LE(Violation(friction, pulled), 0);
  EXPECT_LE(Violation(yaw, turned), 0);
  controller_.reference().pendulum.is_on = true;
  EXPECT_GT(Violation(friction, pulled), 0);
  EXPECT_GT(Violation(yaw, turned), 0);
}
}  // namespace
}  // namespace poise
