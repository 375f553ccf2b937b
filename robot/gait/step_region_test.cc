// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/step_region.h"

#include <ceres/ceres.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/math/so3.h"
#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

const Robot& Humanoid() {
  static const Robot robot = LoadHumanoid();
  return robot;
}

// Second derivation: Ceres minimizes the distance of the sole from a place,
// with the joints between their limits, from several starts. Returns the
// smallest distance, m or rad.
class SoleDistance {
 public:
  SoleDistance(int foot, double sink, const Eigen::Vector2d& u_N,
               const Robot& robot = Humanoid())
      : robot_(robot), foot_(robot.feet[foot]), q_(robot.q_nominal), u_N_(u_N) {
    q_[2] -= sink;
    const Tree& tree = robot_.model.tree;
    for (int body = foot_.body; body != 0;
         body = tree.joints()[body - 1].parent) {
      joints_.push_back(body - 1);
    }
  }

  // The residual of the pose, for Ceres.
  bool operator()(double const* const* x, double* residual) const {
    const Tree& tree = robot_.model.tree;
    Eigen::VectorXd q = q_;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      q[tree.q_start() + joints_[j]] = x[0][j];
    }
    Tick tick(tree, {});
    ComputeTick(tree, q, Eigen::VectorXd::Zero(tree.nv()), &tick);
    const Pose X_WC = tick.X_WB[foot_.body] * foot_.X_BC;
    const Eigen::Vector3d e = LogSo3(X_WC.R);
    const Eigen::Vector2d base = q_.head<2>();
    for (int i = 0; i < 3; ++i) residual[i] = e[i];
    residual[3] = X_WC.p.x() - base.x() - u_N_.x();
    residual[4] = X_WC.p.y() - base.y() - u_N_.y();
    residual[5] = X_WC.p.z();
    return true;
  }

  double Minimize() const {
    double best = 1e9;
    for (const double bend : {0.3, 0.8, 1.3}) {
      best = std::min(best, MinimizeFrom(bend));
    }
    return best;
  }

 private:
  double MinimizeFrom(double bend) const {
    const Tree& tree = robot_.model.tree;
    std::vector<double> x(joints_.size());
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const double nominal = q_[tree.q_start() + joints_[j]];
      const JointLimits& limits = robot_.model.limits[joints_[j]];
      x[j] = std::clamp(nominal * bend / 0.6, limits.lower, limits.upper);
    }
    ceres::Problem problem;
    auto* cost =
        new ceres::DynamicNumericDiffCostFunction<SoleDistance, ceres::CENTRAL>(
            this, ceres::DO_NOT_TAKE_OWNERSHIP);
    cost->AddParameterBlock(static_cast<int>(x.size()));
    cost->SetNumResiduals(6);
    problem.AddResidualBlock(cost, nullptr, x.data());
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const JointLimits& limits = robot_.model.limits[joints_[j]];
      const int i = static_cast<int>(j);
      problem.SetParameterLowerBound(x.data(), i, limits.lower);
      problem.SetParameterUpperBound(x.data(), i, limits.upper);
    }
    ceres::Solver::Options options;
    options.max_num_iterations = 100;
    options.function_tolerance = 1e-14;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return std::sqrt(2 * summary.final_cost);
  }

  const Robot& robot_;
  const Foot& foot_;
  Eigen::VectorXd q_;
  Eigen::Vector2d u_N_;
  std::vector<int> joints_;
};

bool Contains(const StepRegion& region, const Eigen::Vector2d& u_N, double sink,
              double larger) {
  for (int side = 0; side < StepRegion::kSides; ++side) {
    if (StepRegion::normal(side).dot(u_N) >
        region.support(side, sink) + larger) {
      return false;
    }
  }
  return true;
}

// Every place well inside the polygon is reached. The polygon has 12 sides
// around a curved region: at its corners it is larger by 1 - cos(15°), 3.5 %.
RC_GTEST_PROP(StepRegion, EveryPlaceInsideIsReached, ()) {
  static const StepRegion regions[] = {StepRegion(Humanoid(), 0, {}),
                                       StepRegion(Humanoid(), 1, {})};
  const int foot = *rc::gen::inRange(0, 2);
  const StepRegion& region = regions[foot];
  const double sink =
      region.max_sink() * 0.2 * *rc::gen::inRange(0, StepRegion::kSinks);
  const Eigen::Vector2d u_N = 0.5 * (*VectorsXd(2, 1)).head<2>();
  RC_PRE(Contains(region, u_N / 0.95, sink, 0));
  RC_ASSERT(SoleDistance(foot, sink, u_N).Minimize() < 1e-4);
}

// Beyond the polygon, by what its margins to the joint limits leave, nothing is
// reached: the region is not needlessly small.
TEST(StepRegionTest, NoPlaceFarOutsideIsReached) {
  const StepRegion region(Humanoid(), 0, {});
  // 0.1 rad of margin at a leg of 0.7 m, and 3 % of reach.
  constexpr double kMargin = 0.12;
  for (int side = 0; side < StepRegion::kSides; ++side) {
    // Towards the other foot, the legs would cross: joint limits are not what
    // bounds this side.
    const Eigen::Vector2d normal = StepRegion::normal(side);
    const double far = region.support(side, 0.1) + kMargin;
    double nearest = 1e9;
    for (double along = -0.4; along <= 0.4; along += 0.1) {
      const Eigen::Vector2d u =
          far * normal + along * Eigen::Vector2d(-normal.y(), normal.x());
      nearest = std::min(nearest, SoleDistance(0, 0.1, u).Minimize());
    }
    EXPECT_GT(nearest, 1e-3) << "side " << side;
  }
}

TEST(StepRegionTest, FeetAreMirrored) {
  const StepRegion left(Humanoid(), 0, {}), right(Humanoid(), 1, {});
  for (int side = 0; side < StepRegion::kSides; ++side) {
    const int mirrored = (StepRegion::kSides - side) % StepRegion::kSides;
    for (const double sink : {0.0, 0.05, 0.1}) {
      // The search goes in steps of 1 cm, which rounding may shift by one.
      EXPECT_NEAR(left.support(side, sink), right.support(mirrored, sink),
                  0.011);
    }
  }
}

TEST(StepRegionTest, SinkForIsTheSmallestSink) {
  const StepRegion region(Humanoid(), 0, {});
  for (double x = -0.3; x <= 0.4; x += 0.05) {
    const Eigen::Vector2d u(x, 0.08);
    const double sink = region.SinkFor(u);
    if (sink < region.max_sink()) {
      EXPECT_TRUE(Contains(region, u, sink, 1e-9)) << x;
    }
    if (sink > 1e-6) {
      EXPECT_FALSE(Contains(region, u, sink - 1e-6, 0)) << x;
    }
  }
  EXPECT_EQ(region.SinkFor({0, 0.08}), 0);  // The nominal place.
}

// Returns the humanoid with ankles that hardly flex.
Robot WithStiffAnkles() {
  Robot robot = LoadHumanoid();
  const Tree& tree = robot.model.tree;
  for (std::size_t joint = 0; joint < tree.joints().size(); ++joint) {
    const std::string& name = tree.joints()[joint].name;
    if (name.find("ankle_pitch") == std::string::npos) continue;
    const double q =
        robot.q_nominal[tree.q_start() + static_cast<Eigen::Index>(joint)];
    // Below 0.1 rad, the margin to the limits would leave no motion.
    robot.model.limits[joint].lower = q - 0.2;
    robot.model.limits[joint].upper = q + 0.2;
  }
  return robot;
}

// The legs of this robot cannot bend until the base is lower by the bound of
// the settings. The region is then the one of a smaller sink.
TEST(StepRegionTest, TheBaseSinksOnlyAsFarAsTheAnklesAllow) {
  const Robot robot = WithStiffAnkles();
  const StepRegion::Settings settings;
  const Eigen::Vector2d nominal(0, 0.08);
  ASSERT_GT(SoleDistance(0, settings.max_sink, nominal, robot).Minimize(),
            1e-3);
  const StepRegion region(robot, 0, settings);
  EXPECT_GT(region.max_sink(), 0);
  EXPECT_LT(region.max_sink(), settings.max_sink);
  EXPECT_TRUE(Contains(region, nominal, region.max_sink(), 0));
  EXPECT_EQ(region.SinkFor(nominal), 0);
  EXPECT_LT(SoleDistance(0, region.max_sink(), nominal, robot).Minimize(),
            1e-4);
}

// Second derivation: the torque of the knee is the weight times the horizontal
// distance between the knee and the sole. It grows as the base sinks, up to the
// length of the thigh.
TEST(StepRegionTest, TheBaseSinksOnlyAsFarAsTheKneeBears) {
  const Tree& tree = Humanoid().model.tree;
  Tick tick(tree, {});
  ComputeTick(tree, Humanoid().q_nominal, Eigen::VectorXd::Zero(tree.nv()),
              &tick);
  const Foot& foot = Humanoid().feet[0];
  const int knee = *tree.FindJoint("l_knee");
  const int hip = *tree.FindJoint("l_hip_pitch");
  const Eigen::Vector3d p_WK = tick.X_WB[knee + 1].p;
  const double lever =
      ((tick.X_WB[foot.body] * foot.X_BC).p - p_WK).head<2>().norm();
  const double thigh = (tick.X_WB[hip + 1].p - p_WK).norm();
  const double weight = tree.total_mass() * tree.gravity_W().norm();
  const StepRegion::Settings settings;
  const auto sink = [&](double effort) {
    Robot robot = Humanoid();
    robot.model.limits[knee].effort = effort;
    return StepRegion(robot, 0, settings).max_sink();
  };
  const double free = StepRegion(Humanoid(), 0, settings).max_sink();
  EXPECT_EQ(sink(weight * thigh / settings.load), free);
  EXPECT_EQ(sink(weight * lever / settings.load), 0);
  double last = 0;
  for (const double share : {0.2, 0.4, 0.6, 0.8, 1.0}) {
    const double length = lever + share * (thigh - lever);
    const double now = sink(weight * length / settings.load);
    EXPECT_GE(now, last);
    last = now;
  }
  EXPECT_LT(sink(weight * (lever + 0.2 * (thigh - lever)) / settings.load),
            free);
}

// A leg that cannot bend at all has the region of the nominal height.
TEST(StepRegionTest, WithoutSinkTheRegionIsFinite) {
  StepRegion::Settings settings;
  settings.max_sink = 0;
  const StepRegion region(Humanoid(), 0, settings);
  const StepRegion usual(Humanoid(), 0, {});
  for (int side = 0; side < StepRegion::kSides; ++side) {
    EXPECT_EQ(region.support(side, 0), usual.support(side, 0)) << side;
  }
  EXPECT_EQ(region.SinkFor({0, 0.08}), 0);
}

}  // namespace
}  // namespace poise
