// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/self_collision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "poise/dynamics/integrate.h"
#include "poise/dynamics/kinematics.h"
#include "poise/robot/control/tasks/task_fixture.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/simple_robots.h"

namespace poise {
namespace {

// The humanoid with hands at its hips, so that many rows are near their bounds.
class SelfCollisionTest : public TaskTest {
 protected:
  SelfCollisionTest() { Move(0); }

  // Computes the tick at a time after now, with constant rates of the joints.
  void Move(double time) {
    State moved = state_;
    if (time == 0) {
      for (const char* side : {"l_", "r_"}) {
        const double in = side[0] == 'l' ? -1 : 1;
        SetJoint(std::string(side) + "shoulder_pitch", 0.2, &moved);
        SetJoint(std::string(side) + "shoulder_roll", 0, &moved);
        SetJoint(std::string(side) + "shoulder_yaw", 0.9 * in, &moved);
        SetJoint(std::string(side) + "elbow", -0.52, &moved);
      }
      state_ = moved;
    } else {
      Integrate(tree_, state_.q, state_.v, time, moved.q);
    }
    tick_state_ = moved;
    ComputeTick(tree_, moved.q, moved.v, &tick_);
  }

  void SetJoint(const std::string& joint, double value, State* state) const {
    const auto j = tree_.FindJoint(joint);
    ASSERT_TRUE(j) << joint;
    state->q[tree_.q_start() + *j] = value;
  }

  TaskInput InputHere() const {
    TaskInput input{tick_state_, tick_, contacts_, controller_.reference(),
                    unmodelled_vdot_};
    input.capture = capture_;
    return input;
  }

  const Hierarchy& Rows() {
    const int rows = static_cast<int>(task_.inequality_names().size());
    hierarchy_ = Hierarchy(nv_ + 12, {{0, rows}});
    hierarchy_.Clear(1);
    EqualityBlock none = hierarchy_.AddEqualities(0, 0);
    InequalityBlock block = hierarchy_.AddInequalities(0, rows);
    task_.Write(InputHere(), &none, &block);
    return hierarchy_;
  }

  double Distance(int pair) const {
    return ComputePairDistance(task_.model(), task_.model().pairs[pair],
                               tick_.X_WB, 0.01)
        .distance;
  }

  // Parts of the bound of a pair at rest: u without looseness, m/s2.
  double Spring(int pair) const {
    std::vector<Pose> X_WB(tree_.num_bodies());
    ComputePoses(tree_, robot_.q_nominal, &X_WB);
    const CollisionModel& model = task_.model();
    const double nominal =
        ComputePairDistance(model, model.pairs[pair], X_WB, 0.01).distance;
    const double d_min = 0.01 * model.reach;
    const double least = std::min({d_min, nominal / 2, nominal - d_min / 2});
    return std::max(omega_ * omega_ * (Distance(pair) - least),
                    -2 * omega_ * 0.03 * std::sqrt(9.81 * model.reach));
  }

  // Sets a posture at rest in which the hands are at the hips, turned inwards.
  void RestWithArmsTurned(double yaw) {
    SetJoint("l_shoulder_yaw", -yaw, &tick_state_);
    SetJoint("r_shoulder_yaw", yaw, &tick_state_);
    tick_state_.v.setZero();
    ComputeTick(tree_, tick_state_.q, tick_state_.v, &tick_);
  }

  // Sets a posture at rest in which the legs are near each other.
  void RestWithLegsTogether() {
    tick_state_ = {0, robot_.q_nominal, Eigen::VectorXd::Zero(nv_)};
    SetJoint("l_hip_roll", -0.2, &tick_state_);
    SetJoint("r_hip_roll", 0.2, &tick_state_);
    ComputeTick(tree_, tick_state_.q, tick_state_.v, &tick_);
  }

  int NumRows() {
    Rows();
    const Eigen::VectorXd& lower = hierarchy_.lower(0);
    return static_cast<int>((lower.array() > -INFINITY).count());
  }

  bool IsNear(int row) const { return std::isfinite(hierarchy_.lower(0)[row]); }

  SelfCollisionTask task_{robot_};
  State tick_state_;
  Tick tick_{tree_, {}};
  std::vector<ContactTick> contacts_ = controller_.contacts();
  double capture_ = 0;
  const double omega_ =
      *std::find_if(task_.parameters().begin(), task_.parameters().end(),
                    [](const Parameter& p) { return p.name == "omega"; })
           ->value;
  const double scale_ = 4 / (omega_ * omega_ * task_.model().reach);
};

TEST_F(SelfCollisionTest, RowIsTheDerivativeOfTheDistance) {
  const Hierarchy& rows = Rows();
  const Eigen::VectorXd rates = rows.C(0).leftCols(nv_) * state_.v / scale_;
  constexpr double kStep = 1e-5;
  int near = 0;
  for (int i = 0; i < rates.size(); ++i) {
    if (!IsNear(i)) continue;
    ++near;
    Move(kStep);
    const double after = Distance(i);
    Move(-kStep);
    const double before = Distance(i);
    // The error is the third derivative, or the step where a closest point
    // reaches an end: at most |v|^2 / D = 10 m/s2 times the step.
    EXPECT_NEAR(rates[i], (after - before) / (2 * kStep), 10 * kStep)
        << task_.inequality_names()[i];
    ComputeTick(tree_, state_.q, state_.v, &tick_);
  }
  EXPECT_GE(near, 2);
}

// With the base of the tree at any pose and speed, the rows are the same: only
// the joints between two bodies count.
TEST_F(SelfCollisionTest, RowsDoNotDependOnTheMotionOfTheBase) {
  const Eigen::MatrixXd C = Rows().C(0);
  const Eigen::VectorXd lower = hierarchy_.lower(0);
  EXPECT_TRUE(C.leftCols<6>().isZero());
  state_.v.head<6>() << 3, -2, 1, 0.5, 2, -1;
  state_.q[0] += 5;
  tick_state_ = state_;
  ComputeTick(tree_, state_.q, state_.v, &tick_);
  const Hierarchy& rows = Rows();
  EXPECT_LT((rows.C(0) - C).norm(), 1e-12);
  for (int i = 0; i < lower.size(); ++i) {
    if (!std::isfinite(lower[i])) continue;
    EXPECT_NEAR(rows.lower(0)[i], lower[i], 1e-10);
  }
}

// With hands from in front of the hips to inside of them, rows are loosened, as
// they are, and clamped because a hand is too deep. The capture blend loosens
// them more.
TEST_F(SelfCollisionTest, BoundAtRestIsThatOfALoosenedSpring) {
  constexpr double kGravity = 9.81;  // m/s2; largest u of a row.
  for (const double capture : {0.0, 0.3}) {
    capture_ = capture;
    int loosened = 0, strict = 0;
    for (double yaw = 0.3; yaw < 1.1; yaw += 1e-3) {
      RestWithArmsTurned(yaw);
      const Hierarchy& rows = Rows();
      for (int i = 0; i < rows.lower(0).size(); ++i) {
        const double u = Spring(i) + kGravity * capture / (1 - capture);
        EXPECT_EQ(IsNear(i), u < kGravity) << task_.inequality_names()[i];
        if (!IsNear(i)) continue;
        const double bound = rows.lower(0)[i] / scale_;
        EXPECT_NEAR(bound, u > 0 ? -u / (1 - u / kGravity) : -u,
                    1e-9 * (1 + std::abs(bound)));
        // A row never demands more than the spring.
        EXPECT_LE(bound, -u + 1e-9);
        EXPECT_GE(bound, u > 0 ? -INFINITY : 0);
        ++(u > 0 ? loosened : strict);
      }
    }
    EXPECT_GE(loosened, 4);
    EXPECT_GE(strict, 4);
  }
}

// Arms that swing for balance may touch. Legs may not cross.
TEST_F(SelfCollisionTest, OnlyLegsHaveRowsWhileAReleasedFootSwings) {
  ASSERT_GE(NumRows(), 2);
  contacts_[0].in_contact = false;
  EXPECT_GE(NumRows(), 2);  // A foot that follows its reference.
  contacts_[0].is_guided = false;
  EXPECT_EQ(NumRows(), 0);
  RestWithLegsTogether();
  EXPECT_GE(NumRows(), 1);
}

TEST_F(SelfCollisionTest, OnlyLegsHaveRowsAtTheEdgeOfSupport) {
  capture_ = 1;
  EXPECT_EQ(NumRows(), 0);
  RestWithLegsTogether();
  EXPECT_GE(NumRows(), 1);
}

TEST_F(SelfCollisionTest, HasNoRowsInTheStandingPosture) {
  state_ = {0, robot_.q_nominal, Eigen::VectorXd::Zero(nv_)};
  tick_state_ = state_;
  ComputeTick(tree_, state_.q, state_.v, &tick_);
  EXPECT_FALSE(task_.HasRows(InputHere()));
}

TEST_F(SelfCollisionTest, HasNoRowsWhileTheRobotCatchesItselfBySteps) {
  Rows();
  ASSERT_TRUE(task_.HasRows(InputHere()));
  controller_.reference().pendulum.is_on = true;
  EXPECT_FALSE(task_.HasRows(InputHere()));
}

TEST_F(SelfCollisionTest, NamesBothBodies) {
  const auto& names = task_.inequality_names();
  EXPECT_NE(
      std::find(names.begin(), names.end(), "self_collision.l_hand.l_thigh"),
      names.end());
}

TEST_F(SelfCollisionTest, DoesNotAllocate) {
  Rows();
  const int rows = static_cast<int>(task_.inequality_names().size());
  hierarchy_.Clear(1);
  EqualityBlock none = hierarchy_.AddEqualities(0, 0);
  InequalityBlock block = hierarchy_.AddInequalities(0, rows);
  const CountMalloc count;
  EXPECT_TRUE(task_.HasRows(InputHere()));
  task_.Write(InputHere(), &none, &block);
  EXPECT_EQ(count.allocations(), 0);
}

// Two balls: one on the trunk, and one on an arm of a turning and a sliding or
// turning joint. The closest points are their centers, so that d̈ is the
// acceleration along the line plus |v|^2 / D of the velocity v across the line.
TEST(SelfCollision, BoundHasTheAccelerationOfTheClosestPoints) {
  for (const JointType type : {JointType::kRevolute, JointType::kPrismatic}) {
    Inertia M;
    M.mass = 1;
    M.I_G_B = 0.01 * Eigen::Matrix3d::Identity();
    const auto joint = [](std::string parent, std::string child,
                          JointType moves, Eigen::Vector3d p_PF,
                          Eigen::Vector3d axis_F) {
      JointSpec spec;
      spec.name = child + "_joint";
      spec.type = moves;
      spec.parent = std::move(parent);
      spec.child = std::move(child);
      spec.X_PF.p = p_PF;
      spec.axis_F = axis_F;
      return spec;
    };
    Robot robot = MakeRobot(
        TreeBuilder()
            .AddLink("trunk", M)
            .AddLink("upper", M)
            .AddLink("lower", M)
            .AddJoint(joint("trunk", "upper", JointType::kRevolute,
                            {0, 0.3, 0.4}, {1, 0, 0.2}))
            .AddJoint(joint("upper", "lower", type, {0, -0.1, -0.3}, {0, 1, 0}))
            .Build());
    const Tree& tree = robot.model.tree;
    Pose X;
    X.p = {0, 0.1, -0.02};
    robot.model.collisions.push_back(
        {*tree.FindFrame("lower"), X, Sphere{0.06}});
    robot.model.collisions.push_back(
        {*tree.FindFrame("trunk"), {}, Sphere{0.2}});
    const SelfCollisionTask task(robot);
    ASSERT_EQ(task.model().pairs.size(), 1u);

    State state{0, robot.q_nominal, Eigen::VectorXd::Zero(tree.nv())};
    state.q.tail(2) << -0.5, type == JointType::kRevolute ? 0.4 : -0.1;
    state.v.tail(2) << -0.8, 0.7;
    Tick tick(tree, {});
    const auto closest_at = [&](double time) {
      Eigen::VectorXd q(tree.nq());
      Integrate(tree, state.q, state.v, time, q);
      ComputeTick(tree, q, state.v, &tick);
      return ComputePairDistance(task.model(), task.model().pairs[0], tick.X_WB,
                                 0);
    };
    constexpr double kStep = 1e-4;
    const ClosestPoints before = closest_at(-kStep), after = closest_at(kStep);
    const ClosestPoints now = closest_at(0);
    const double rate = (after.distance - before.distance) / (2 * kStep);
    const double numeric =
        (after.distance - 2 * now.distance + before.distance) / kStep / kStep;
    const Eigen::Vector3d v =
        (after.p_A - after.p_B - before.p_A + before.p_B) / (2 * kStep);
    const Eigen::Vector3d across = v - now.gradient.dot(v) * now.gradient;
    const double expected =
        numeric - across.squaredNorm() / (now.p_A - now.p_B).norm();

    Hierarchy hierarchy(tree.nv(), {{0, 1}});
    hierarchy.Clear(1);
    EqualityBlock none = hierarchy.AddEqualities(0, 0);
    InequalityBlock block = hierarchy.AddInequalities(0, 1);
    const Reference reference;
    Eigen::VectorXd unmodelled = Eigen::VectorXd::Zero(tree.nv());
    const std::vector<ContactTick> contacts;
    task.Write({state, tick, contacts, reference, unmodelled}, &none, &block);
    ASSERT_TRUE(std::isfinite(block.lower[0]));
    const double d_min = *task.parameters()[0].value;
    const double w = *task.parameters()[1].value;
    const double scale = 4 / (w * w * task.model().reach);
    // A pair that is too near moves apart at a limited speed.
    const double apart = 0.03 * std::sqrt(9.81 * task.model().reach);
    const double u =
        2 * w * rate + std::max(w * w * (now.distance - d_min), -2 * w * apart);
    ASSERT_LT(u, 0);
    // Second differences have an error of 1e-16 / step^2.
    EXPECT_NEAR(block.lower[0] / scale, -u - expected, 1e-6 * std::abs(u));

    // Unmodelled accelerations act like accelerations of the solution.
    const double bound = block.lower[0];
    const Eigen::RowVectorXd c = block.C.row(0);
    unmodelled.tail(2) << 3, -5;
    task.Write({state, tick, contacts, reference, unmodelled}, &none, &block);
    EXPECT_NEAR(block.lower[0], bound - c.dot(unmodelled), 1e-12);
  }
}

// A ball on a slider of a turning arm flies at a ball of the trunk. The slider
// is far out, so that its travel makes most of the lever of 1 m.
TEST(SelfCollision, SeesAFastBodyOnASliderThatIsFarOut) {
  Inertia M;
  M.mass = 1;
  M.I_G_B = 0.01 * Eigen::Matrix3d::Identity();
  JointSpec turn, slide;
  turn.name = "turn";
  turn.type = JointType::kRevolute;
  turn.parent = "trunk";
  turn.child = "arm";
  turn.X_PF.p = {0, 0, 0.6};
  turn.axis_F = {1, 0, 0};
  slide.name = "slide";
  slide.type = JointType::kPrismatic;
  slide.parent = "arm";
  slide.child = "hand";
  slide.X_PF.p = {0, 0, 0.25};
  slide.axis_F = {0, 0, 1};
  Robot robot = MakeRobot(TreeBuilder()
                              .AddLink("trunk", M)
                              .AddLink("arm", M)
                              .AddLink("hand", M)
                              .AddJoint(turn)
                              .AddJoint(slide)
                              .Build());
  const Tree& tree = robot.model.tree;
  constexpr double kGap = 0.03;  // m.
  Pose X;
  X.p = {0, 0.25 + kGap, 1.6};
  robot.model.collisions.push_back({*tree.FindFrame("hand"), {}, Sphere{0.05}});
  robot.model.collisions.push_back({*tree.FindFrame("trunk"), X, Sphere{0.2}});
  const SelfCollisionTask task(robot);
  ASSERT_EQ(task.model().pairs.size(), 1u);
  State state{0, robot.q_nominal, Eigen::VectorXd::Zero(tree.nv())};
  state.q.tail(2) << 0, 0.75;
  Tick tick(tree, {});
  const Reference reference;
  const Eigen::VectorXd unmodelled = Eigen::VectorXd::Zero(tree.nv());
  const std::vector<ContactTick> contacts;
  const auto has_rows = [&](double speed) {
    state.v.tail(2) << -speed / 1.0, 0;
    ComputeTick(tree, state.q, state.v, &tick);
    return task.HasRows({state, tick, contacts, reference, unmodelled});
  };
  // On the bound, the distance shrinks at w / 2 (d - d_min).
  const double w = *task.parameters()[1].value;
  const double bound = w / 2 * (kGap - *task.parameters()[0].value);
  EXPECT_TRUE(has_rows(1.1 * bound));
  EXPECT_FALSE(has_rows(0.9 * bound));
  EXPECT_FALSE(has_rows(-1.1 * bound));
}

}  // namespace
}  // namespace poise
