// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/joint_drag.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

#include "poise/dynamics/tick.h"
#include "poise/tests/util/decompositions.h"
#include "poise/tests/util/random_tree.h"
#include "poise/tests/util/simple_robots.h"

namespace poise {
namespace {

constexpr double kDt = 1e-3;
// Tolerance for two solutions of a linear system with a condition of about 1e4.
constexpr double kAgreement = 1e-10;

PlantState StateOf(const Robot& robot, std::mt19937* draw) {
  const Tree& tree = robot.model.tree;
  PlantState state;
  state.q = MakeRandomConfiguration(tree, draw);
  state.v = MakeRandomVector(tree.nv(), draw);
  state.F_Co_C.assign(robot.feet.size(), Vector6d::Zero());
  return state;
}

TEST(JointDrag, ExistsIfTheModelHasDampingOrFriction) {
  std::mt19937 draw(1);
  Robot robot = MakeRobot(MakeRandomTree(4, &draw));
  EXPECT_FALSE(JointDrag(robot, kDt).exists());
  robot.model.limits[2].damping = 0.1;
  EXPECT_TRUE(JointDrag(robot, kDt).exists());
  robot.model.limits[2] = robot.model.limits[0];
  robot.model.limits[3].friction = 0.1;
  EXPECT_TRUE(JointDrag(robot, kDt).exists());
}

// Checks the definition: with the drag as a force, the step ends with the
// velocity v_end for which the drag is -D v_end.
TEST(JointDrag, IsProportionalToTheSpeedAtTheEndOfTheStep) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 draw(seed);
    Robot robot = MakeRobot(MakeRandomTree(6, &draw));
    const Tree& tree = robot.model.tree;
    for (int j = 0; j < 6; ++j) robot.model.limits[j].damping = 0.3 * j;
    const int frame = *tree.FindFrame("link5");
    Foot foot{"foot", tree.frames()[frame].body, frame, {}, {}, {}};
    foot.X_BC.p = MakeRandomVector(3, &draw);
    robot.feet.push_back(foot);
    PlantState state = StateOf(robot, &draw);
    state.F_Co_C[0] = 20 * MakeRandomVector(6, &draw);
    const Eigen::VectorXd tau = 5 * MakeRandomVector(6, &draw);
    JointDrag joint_drag(robot, kDt);
    const Eigen::VectorXd drag = joint_drag.Compute(state, tau);

    Tick tick(tree, {frame});
    ComputeTick(tree, state.q, state.v, &tick);
    const Pose X_WC = tick.X_WB[foot.body] * foot.X_BC;
    // The foot's wrench about the link's origin.
    const Eigen::Vector3d f_W = X_WC.R * state.F_Co_C[0].tail<3>();
    Vector6d F_W;
    F_W << X_WC.R * state.F_Co_C[0].head<3>() +
               (X_WC.p - tick.frames[0].X_WF.p).cross(f_W),
        f_W;
    Eigen::VectorXd force = tick.frames[0].J_WF_W.transpose() * F_W - tick.N;
    force.tail(6) += tau + drag;
    const Eigen::VectorXd v_end =
        state.v + kDt * LeastSquaresSolution(tick.M, force).x;
    for (int j = 0; j < 6; ++j) {
      EXPECT_NEAR(drag[j], -0.3 * j * v_end[6 + j],
                  kAgreement * (1 + drag.norm()));
    }
  }
}

// A single hinge has an inertia of 2 kg m2 and a dry friction of 3 N m.
TEST(JointDrag, HoldsByDryFrictionAndNeverReversesTheMotion) {
  Inertia M;
  M.mass = 1;
  M.I_G_B = 2 * Eigen::Matrix3d::Identity();
  JointSpec hinge;
  hinge.name = "hinge";
  hinge.type = JointType::kRevolute;
  hinge.parent = "wall";
  hinge.child = "wheel";
  hinge.axis_F = Eigen::Vector3d::UnitZ();
  Robot robot = MakeRobot(TreeBuilder()
                              .AddLink("wall", M)
                              .AddLink("wheel", M)
                              .AddJoint(hinge)
                              .Build(BaseType::kFixed));
  robot.model.limits[0].friction = 3;
  JointDrag joint_drag(robot, kDt);
  PlantState state;
  state.q = Eigen::VectorXd::Zero(1);
  const auto drag = [&](double v, double tau) {
    state.v = Eigen::VectorXd::Constant(1, v);
    return joint_drag.Compute(state, Eigen::VectorXd::Constant(1, tau))[0];
  };
  // At high speed: the full dry friction, against the motion, for any torque.
  EXPECT_NEAR(drag(10, 0), -3, 1e-3);
  EXPECT_NEAR(drag(-10, 5), 3, 2e-3);
  // At rest: the drag balances the torque, except for the creep.
  EXPECT_NEAR(drag(0, 1), -1, 0.07);
  EXPECT_NEAR(drag(0, -1), 1, 0.07);
  // A larger torque makes it slip. The inertia is far below dt f / v_0.
  EXPECT_NEAR(drag(0, 10), -3, 1e-9);
  EXPECT_NEAR(drag(0, -3.5), 3, 1e-9);
  // The drag does not reverse the motion: v + dt (tau + drag) / I keeps the
  // sign of v.
  for (const double v : {1e-3, 1e-4, 1e-5}) {
    EXPECT_GT(v + kDt * drag(v, 0) / 2, 0) << v;
  }
}

}  // namespace
}  // namespace poise
