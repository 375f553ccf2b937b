// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/loop_closure.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/robot/control/contacts.h"
#include "poise/robot/control/task.h"
#include "poise/robot/control/tasks/contact.h"
#include "poise/robot/control/tasks/task_fixture.h"
#include "poise/tests/util/decompositions.h"

namespace poise {
namespace {

class LoopClosureTest : public TaskTest {
 protected:
  // Returns the contacts of a robot whose joints of this name, with the prefix
  // l_ and r_, move the feet by a fraction of what they do: 0 locks them.
  std::vector<ContactTick> Weakened(const char* joint, double fraction) {
    std::vector<ContactTick> contacts = controller_.contacts();
    for (const char* side : {"l_", "r_"}) {
      const int j = *tree_.FindJoint(side + std::string(joint));
      for (ContactTick& contact : contacts) {
        contact.J_WC_C.col(6 + j) *= fraction;
      }
    }
    return contacts;
  }

  LockedMotions Locked(const std::vector<ContactTick>& contacts) {
    const LoopClosure loop(robot_.model, robot_.feet[0].body,
                           robot_.feet[1].body);
    LockedMotions locked;
    loop.FindLocked(contacts[0], contacts[1], &locked);
    return locked;
  }

  Eigen::MatrixXd Stacked(const std::vector<ContactTick>& contacts) {
    Eigen::MatrixXd J(12, nv_);
    J << contacts[0].J_WC_C, contacts[1].J_WC_C;
    return J;
  }
};

TEST_F(LoopClosureTest, FindsNothingForLegsOfSixJoints) {
  EXPECT_EQ(Locked(controller_.contacts()).count, 0);
}

// The rank of both contacts' Jacobian, with the base's columns, is a second
// derivation: the legs of the fixture are parallel, as they stand.
TEST_F(LoopClosureTest, FindsTheRankOfBothContacts) {
  for (const char* joint : {"ankle_roll", "hip_yaw", "knee"}) {
    const std::vector<ContactTick> contacts = Weakened(joint, 0);
    const Eigen::MatrixXd J = Stacked(contacts);
    const Eigen::VectorXd sigma = JacobiSvd(J).sigma;
    const int dependent = static_cast<int>((sigma.array() < 1e-9).count());
    const LockedMotions locked = Locked(contacts);
    EXPECT_EQ(locked.count, dependent) << joint;
    for (int k = 0; k < locked.count; ++k) {
      // Rounding of sums of some ten products of about 1.
      EXPECT_LT((locked.n.col(k).transpose() * J).norm(), 1e-6) << joint;
      EXPECT_EQ(locked.share[k], 1) << joint;
      for (int i = 0; i <= k; ++i) {
        EXPECT_NEAR(
            locked.n.col(i).dot(locked.metric.cwiseProduct(locked.n.col(k))),
            i == k ? 1 : 0, 1e-9);
      }
    }
  }
  EXPECT_EQ(Locked(Weakened("ankle_roll", 0)).count, 1);
}

TEST_F(LoopClosureTest, ShareGrowsAsAJointLosesItsEffect) {
  double last = 0;
  bool is_between = false;
  for (double fraction = 0.1; fraction > 1e-5; fraction *= 0.9) {
    const LockedMotions locked = Locked(Weakened("ankle_roll", fraction));
    const double share = locked.count > 0 ? locked.share[0] : 0;
    EXPECT_GE(share, last);
    is_between |= share > 0.2 && share < 0.8;
    last = share;
  }
  EXPECT_TRUE(is_between);
  EXPECT_EQ(last, 1);
}

// The rows without and with the locked motions differ by the projection; the
// bound on the motion grows from 0 to infinity with its share.
TEST_F(LoopClosureTest, ContactBoundsAMotionThatIsLockedInPart) {
  const ContactTask task(robot_.model, robot_.feet);
  double last_bound = 0;
  for (double fraction = 0.1; fraction > 1e-5; fraction *= 0.9) {
    const std::vector<ContactTick> contacts = Weakened("ankle_roll", fraction);
    const LockedMotions locked = Locked(contacts);
    hierarchy_ = Hierarchy(nv_ + 12, {{12, 6}});
    hierarchy_.Clear(1);
    EqualityBlock rows = hierarchy_.AddEqualities(0, 12);
    InequalityBlock bounds = hierarchy_.AddInequalities(0, 6);
    task.Write({state_, controller_.tick(), contacts, controller_.reference(),
                unmodelled_vdot_},
               &rows, &bounds);
    const Eigen::MatrixXd J = Stacked(contacts);
    if (locked.count == 0) {
      EXPECT_EQ((rows.B.leftCols(nv_) - J).norm(), 0);
      continue;
    }
    ASSERT_EQ(locked.count, 1);
    const auto n = locked.n.col(0);
    const Eigen::RowVectorXd c = n.transpose() * J;
    const Eigen::MatrixXd expected = J - locked.metric.cwiseProduct(n) * c;
    EXPECT_LT((rows.B.leftCols(nv_) - expected).norm(), 1e-9);
    EXPECT_LT(std::abs(n.dot(rows.b)), 1e-9);
    if (locked.share[0] == 1) {
      EXPECT_TRUE(std::isinf(bounds.upper[0]));
      continue;
    }
    EXPECT_LT((bounds.C.row(0).head(nv_) - c).norm(), 1e-9);
    const double bound = (bounds.upper[0] - bounds.lower[0]) / 2;
    EXPECT_GT(bound, last_bound);
    last_bound = bound;
  }
  EXPECT_GT(last_bound, 0);
}

// A copy of the left foot that is in the air precedes the two feet. The rows of
// the two feet are those without the copy, also where motions are locked.
TEST_F(LoopClosureTest, ContactOfAThirdFootInTheAirChangesNoRow) {
  const std::vector<ContactTick> two = Weakened("ankle_roll", 1e-5);
  ASSERT_EQ(Locked(two).count, 1);
  std::vector<ContactTick> three = {two[0], two[0], two[1]};
  three[0].in_contact = false;
  std::vector<Foot> feet = {robot_.feet[0], robot_.feet[0], robot_.feet[1]};
  feet[0].name = "third_foot";
  const auto rows_of = [&](const std::vector<Foot>& of,
                           const std::vector<ContactTick>& contacts) {
    const int rows = 6 * static_cast<int>(of.size());
    const ContactTask task(robot_.model, of);
    hierarchy_ = Hierarchy(nv_ + rows, {{rows, rows - 6}});
    hierarchy_.Clear(1);
    EqualityBlock equalities = hierarchy_.AddEqualities(0, rows);
    InequalityBlock bounds = hierarchy_.AddInequalities(0, rows - 6);
    task.Write({state_, controller_.tick(), contacts, controller_.reference(),
                unmodelled_vdot_},
               &equalities, &bounds);
    Eigen::MatrixXd all(12, nv_ + 1);
    all << equalities.B.bottomRows(12).leftCols(nv_), equalities.b.tail(12);
    return all;
  };
  EXPECT_EQ(rows_of(feet, three), rows_of(robot_.feet, two));
}

}  // namespace
}  // namespace poise
