// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/step_yardstick.h"

#include <algorithm>
#include <cmath>

#include "poise/dynamics/tick.h"
#include "poise/robot/gait/gait_settings.h"
#include "poise/robot/gait/step_region.h"
#include "poise/robot/nominal_tick.h"
#include "poise/sim/yardstick.h"

namespace poise {
namespace {

// Corners of a sole on the ground, m, around its center.
std::vector<Eigen::Vector2d> SoleAround(const Foot& foot, const Pose& X_WC) {
  std::vector<Eigen::Vector2d> corners;
  for (const Eigen::Vector2d& corner : foot.polygon_C) {
    const Eigen::Vector3d p_C(corner.x(), corner.y(), 0);
    corners.push_back((X_WC.R * p_C).head<2>());
  }
  return corners;
}

// The half-plane normal' x <= bound.
struct HalfPlane {
  Eigen::Vector2d normal;
  double bound;
};

// Returns the corners of an intersection of half-planes.
std::vector<Eigen::Vector2d> Corners(const std::vector<HalfPlane>& planes) {
  constexpr double kParallel = 1e-9, kOnEdge = 1e-9;
  std::vector<Eigen::Vector2d> corners;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      Eigen::Matrix2d N;
      N << planes[i].normal.transpose(), planes[j].normal.transpose();
      if (std::abs(N.determinant()) < kParallel) continue;
      const Eigen::Vector2d x =
          N.inverse() * Eigen::Vector2d(planes[i].bound, planes[j].bound);
      const bool is_inside =
          std::all_of(planes.begin(), planes.end(), [&](const HalfPlane& p) {
            return p.normal.dot(x) <= p.bound + kOnEdge;
          });
      if (is_inside) corners.push_back(x);
    }
  }
  return corners;
}

Pose SolePose(const Robot& robot, const Tick& tick, int foot) {
  return tick.X_WB[robot.feet[foot].body] * robot.feet[foot].X_BC;
}

}  // namespace

double ComputeStepYardstick(double mass, double gravity,
                            const Eigen::Vector3d& com,
                            const StepOption& option, const Eigen::Vector2d& u,
                            double duration, double T) {
  const double e = std::exp(-std::sqrt(gravity / com.z()) * T);
  std::vector<Eigen::Vector2d> caught = option.stance;
  caught.insert(caught.end(), option.landing.begin(), option.landing.end());
  std::vector<Eigen::Vector2d> sum;
  for (const Eigen::Vector2d& k : caught) {
    for (const Eigen::Vector2d& s : option.stance) {
      sum.push_back(e * k + (1 - e) * s);
    }
  }
  return ComputeYardstick(mass, gravity, com, sum, u, duration, com.z())
      .lipm_Ns;
}

std::vector<Eigen::Vector2d> StepReach(const Robot& robot, int foot) {
  const GaitSettings settings =
      Scaled(GaitSettings{}, NominalTick(robot).p_WG.z());
  const StepRegion swing(robot, foot, settings.region);
  const StepRegion stance(robot, 1 - foot, settings.region);
  const double side = foot == 0 ? 1 : -1;
  const double width =
      robot.feet[foot].half_size.y() + robot.feet[1 - foot].half_size.y();
  std::vector<HalfPlane> planes = {{Eigen::Vector2d(0, -side), -width}};
  for (int i = 0; i < StepRegion::kSides; ++i) {
    // The other side points to -normal(i): the stance foot is there.
    const int opposite = (i + StepRegion::kSides / 2) % StepRegion::kSides;
    planes.push_back({StepRegion::normal(i),
                      swing.support(i, swing.max_sink()) +
                          stance.support(opposite, stance.max_sink())});
  }
  return Corners(planes);
}

std::optional<double> ComputeStepYardstick(const Robot& robot,
                                           const Eigen::Vector2d& u,
                                           double duration) {
  if (robot.feet.size() != 2) return std::nullopt;
  const Tick tick = NominalTick(robot);
  const Tree& tree = robot.model.tree;
  double best = 0;
  for (int foot = 0; foot < 2; ++foot) {
    StepOption option;
    const Pose X_WC = SolePose(robot, tick, 1 - foot);
    for (const Eigen::Vector2d& corner :
         SoleAround(robot.feet[1 - foot], X_WC)) {
      option.stance.push_back(X_WC.p.head<2>() + corner);
    }
    const Pose X_WSwing = SolePose(robot, tick, foot);
    const auto sole = SoleAround(robot.feet[foot], X_WSwing);
    for (const Eigen::Vector2d& place : StepReach(robot, foot)) {
      for (const Eigen::Vector2d& corner : sole) {
        option.landing.push_back(X_WC.p.head<2>() + place + corner);
      }
    }
    const Eigen::Vector3d com =
        tick.p_WG - X_WC.p.z() * Eigen::Vector3d::UnitZ();
    best = std::max(best, ComputeStepYardstick(
                              tree.total_mass(), tree.gravity_W().norm(), com,
                              option, u, duration, kStepYardstickTime));
  }
  return best;
}

}  // namespace poise
