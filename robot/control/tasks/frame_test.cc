// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Compares the rows on a sole or a link, on the ground and in the air, with its
// motion a moment later.
#include "poise/robot/control/tasks/frame.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/hqp/hierarchy.h"
#include "poise/math/so3.h"
#include "poise/robot/control/contacts.h"
#include "poise/robot/control/reference.h"
#include "poise/robot/control/task.h"
#include "poise/robot/control/tasks/contact.h"
#include "poise/robot/control/tasks/swing.h"
#include "poise/robot/control/tasks/task_fixture.h"

namespace poise {
namespace {

// The sole's frame, anywhere on the foot's link, moves as its Jacobian
// predicts.
TEST_F(TaskTest, AContactMovesAsItsLinkDoes) {
  const Pose X_FC{ExpSo3({0.3, -0.2, 0.5}), Eigen::Vector3d(0.05, -0.03, -0.4)};
  const auto at = [&](const Tick& tick) {
    ContactTick contact;
    contact.J_WC_C.setZero(6, nv_);
    ComputeContact(tick.frames[0], X_FC, &contact);
    return contact;
  };
  const auto twist_W = [](const ContactTick& contact) {
    Vector6d V_W;
    V_W << contact.X_WC.R * contact.V_WC_C.head<3>(),
        contact.X_WC.R * contact.V_WC_C.tail<3>();
    return V_W;
  };
  const double h = 1e-6;
  const Eigen::VectorXd y = RandomY();
  const ContactTick now = at(controller_.tick());
  const ContactTick before = at(After(-h, y)), after = at(After(h, y));
  EXPECT_LT((now.J_WC_C * state_.v - now.V_WC_C).norm(), 1e-12);
  Vector6d moved;
  moved << LogSo3(after.X_WC.R * before.X_WC.R.transpose()),
      after.X_WC.p - before.X_WC.p;
  // Central differences over 1e-6 s have an error of 1e-5 of the rates.
  EXPECT_LT((moved / (2 * h) - twist_W(now)).norm(), 1e-5);
  const Vector6d rate = (twist_W(after) - twist_W(before)) / (2 * h);
  const Vector6d A_C = now.J_WC_C * y.head(nv_) + now.Jdot_v_C;
  EXPECT_LT((now.X_WC.R.transpose() * rate.head<3>() - A_C.head<3>()).norm(),
            1e-4);
  EXPECT_LT((now.X_WC.R.transpose() * rate.tail<3>() - A_C.tail<3>()).norm(),
            1e-4);
}

TEST_F(TaskTest, ASwingFootFollowsItsReference) {
  SwingTask task(robot_.feet[0], 0);
  for (const Parameter& each : task.parameters()) {
    *each.value = each.name == "kp" ? 7 : 3;
  }
  std::vector<ContactTick> contacts = controller_.contacts();
  const TaskInput now{state_, controller_.tick(), contacts,
                      controller_.reference(), unmodelled_vdot_};
  EXPECT_FALSE(task.HasRows(now));
  contacts[0].in_contact = false;
  EXPECT_TRUE(task.HasRows(now));
  contacts[0].is_guided = false;
  EXPECT_FALSE(task.HasRows(now));

  const ContactTick& foot = controller_.contacts()[0];
  Vector6d e;
  e << 0.3, -0.2, 0.1, 0.04, -0.05, 0.06;
  FrameReference& reference = controller_.reference().feet[0];
  reference.X_WF = {ExpSo3(e.head<3>()) * foot.X_WC.R,
                    foot.X_WC.p + e.tail<3>()};
  reference.V_WF_W << 1, 2, 3, 4, 5, 6;
  reference.A_WF_W << 9, 8, 7, 6, 5, 4;
  const Vector6d wanted_W = reference.A_WF_W + 3 * reference.V_WF_W + 7 * e;
  const Eigen::VectorXd y = RandomY();
  Vector6d expected =
      foot.J_WC_C * y.head(nv_) + foot.Jdot_v_C + 3 * foot.V_WC_C;
  expected.head<3>() -= foot.X_WC.R.transpose() * wanted_W.head<3>();
  expected.tail<3>() -= foot.X_WC.R.transpose() * wanted_W.tail<3>();
  EXPECT_LT((Residual(task, y) - expected).norm(), 1e-9);
}

TEST_F(TaskTest, ContactMovesASoleUprightAndToTheGround) {
  const ContactTask task(robot_.model, robot_.feet);
  const ContactTick& contact = controller_.contacts()[0];
  const Eigen::VectorXd y = RandomY();
  const Eigen::VectorXd at_ground = Residual(task, y);
  const Eigen::VectorXd expected =
      (contact.J_WC_C * y.head(nv_) + contact.Jdot_v_C + 30 * contact.V_WC_C);
  EXPECT_LT((at_ground.head<6>() - expected).norm(), 1e-9);
  // The floor is 1 cm lower: the foot accelerates down by kp times 1 cm.
  controller_.reference().ground_z -= 0.01;
  const Eigen::VectorXd above = Residual(task, y);
  EXPECT_NEAR((above - at_ground)[5], 100 * 0.01, 1e-9);

  // A tilted sole rotates back against its tilt. Its heading is not corrected.
  std::vector<ContactTick> contacts = controller_.contacts();
  const Eigen::Matrix3d heading = ExpSo3({0, 0, 0.7});
  const Eigen::Vector3d tilt(0.03, -0.02, 0);  // rad, in the foot's axes.
  contacts[0].X_WC = {heading * ExpSo3(tilt), Eigen::Vector3d::Zero()};
  controller_.reference().ground_z = 0;
  hierarchy_ = Hierarchy(nv_ + 12, {{12, 0}});
  hierarchy_.Clear(1);
  EqualityBlock rows = hierarchy_.AddEqualities(0, 12);
  InequalityBlock none = hierarchy_.AddInequalities(0, 0);
  task.Write({state_, controller_.tick(), contacts, controller_.reference(),
              unmodelled_vdot_},
             &rows, &none);
  const Eigen::VectorXd asked =
      contacts[0].Jdot_v_C + 30 * contacts[0].V_WC_C - rows.b.head<6>();
  EXPECT_LT((asked.head<3>() + 100 * tilt).norm(), 2e-3);  // sin(x) for x.
  EXPECT_LT(asked.tail<3>().norm(), 1e-12);
}

TEST_F(TaskTest, FrameFollowsItsReference) {
  FrameTask task("l_foot", 0, 0);
  EXPECT_EQ(task.name(), "frame.l_foot");
  EXPECT_EQ(task.equality_names()[5], "frame.l_foot.vz");
  const double kp = 7, kd = 3;
  for (const Parameter& each : task.parameters()) {
    if (each.name == "kp") *each.value = kp;
    if (each.name == "kd") *each.value = kd;
  }
  const double h = 1e-6;
  const Eigen::VectorXd y = RandomY();
  const Vector6d rate =
      (After(h, y).frames[0].V_WF_W - After(-h, y).frames[0].V_WF_W) / (2 * h);

  const FrameTick frame = controller_.tick().frames[0];
  Vector6d e;
  e << 0.3, -0.2, 0.1, 0.04, -0.05, 0.06;
  FrameReference reference;
  reference.X_WF = {ExpSo3(e.head<3>()) * frame.X_WF.R,
                    frame.X_WF.p + e.tail<3>()};
  reference.V_WF_W << 1, 2, 3, 4, 5, 6;
  reference.A_WF_W << 9, 8, 7, 6, 5, 4;
  controller_.reference().frames = {reference};
  const Vector6d wanted =
      reference.A_WF_W + kd * (reference.V_WF_W - frame.V_WF_W) + kp * e;
  // Central differences over 1e-6 s have an error of 1e-5 of the rates.
  EXPECT_LT((Residual(task, y) - (rate - wanted)).norm(), 1e-4);
}

TEST_F(TaskTest, FrameOmitsDisabledRows) {
  FrameTask task("l_foot", 0, 0);
  controller_.reference().frames.resize(1);
  const Eigen::VectorXd y = RandomY();
  const Vector6d both = Residual(task, y);
  for (const std::string half : {"orientation", "position"}) {
    for (const Parameter& each : task.parameters()) {
      if (each.name == "orientation" || each.name == "position") {
        *each.value = each.name == half ? 1 : 0;
      }
    }
    Vector6d wanted = both;
    wanted.segment<3>(half == "position" ? 0 : 3).setZero();
    EXPECT_EQ(Residual(task, y), wanted) << half;
  }
}

// A step has its own gains and weights.
TEST_F(TaskTest, AStepFollowsItsReferenceWithItsOwnGains) {
  controller_.stance().Step(0);
  Command command;
  command.tau.setZero(n_);
  state_.time += 1e-3;
  controller_.Update(state_, &command);
  ASSERT_TRUE(controller_.contacts()[0].is_stepping);
  const SwingTask swing(robot_.feet[0], 0);
  const Eigen::VectorXd y = RandomY();
  const Eigen::VectorXd before = Residual(swing, y);
  EXPECT_EQ(hierarchy_.weight(0)[0], 0.41);
  EXPECT_EQ(hierarchy_.weight(0)[3], 0.2);
  EXPECT_EQ(hierarchy_.weight(0)[5], 3.6);
  const Eigen::Vector3d p(0.01, -0.02, 0.03), v(0.1, 0.2, -0.3);
  FrameReference& foot = controller_.reference().feet[0];
  foot.X_WF.p += p;
  foot.V_WF_W.tail<3>() += v;
  const Eigen::Matrix3d R_CW = controller_.contacts()[0].X_WC.R.transpose();
  EXPECT_LT((before.tail<3>() - Residual(swing, y).tail<3>() -
             R_CW * (720 * p + 53.7 * v))
                .norm(),
            1e-9);
}
}  // namespace
}  // namespace poise
