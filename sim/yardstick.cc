// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/yardstick.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/dynamics/tick.h"
#include "poise/robot/feet/feet.h"

namespace poise {

namespace {

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Returns the distance from p along the unit vector u to the edge of a convex
// polygon, m. Returns 0 if p is outside or the polygon has no area.
double DistanceToEdge(const std::vector<Eigen::Vector2d>& polygon,
                      const Eigen::Vector2d& p, const Eigen::Vector2d& u) {
  if (polygon.size() < 3) return 0;
  double distance = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    // The corners are counterclockwise, so the inside is to the left of each
    // edge.
    const double inside = Cross(edge, p - polygon[i]);
    if (inside < 0) return 0;
    const double approach = -Cross(edge, u);
    if (approach > 0) distance = std::min(distance, inside / approach);
  }
  return distance;
}

}  // namespace

Yardstick ComputeYardstick(double mass, double gravity,
                           const Eigen::Vector3d& com,
                           const std::vector<Eigen::Vector2d>& soles,
                           const Eigen::Vector2d& u, double duration,
                           double push_height) {
  const double omega = std::sqrt(gravity / com.z());
  const double rho =
      DistanceToEdge(ConvexHull(soles), com.head<2>(), u.normalized());
  const double x = omega * duration;
  const double stretch = x > 0 ? x / -std::expm1(-x) : 1;
  const double lipm_Ns = mass * omega * rho * stretch;
  return {lipm_Ns, lipm_Ns * com.z() / push_height};
}

std::optional<Yardstick> ComputeYardstick(const Robot& robot,
                                          const Eigen::VectorXd& q,
                                          const Eigen::Vector2d& u,
                                          double duration, int body,
                                          const Eigen::Vector3d& p_BoQ_B,
                                          const std::vector<bool>& down) {
  const Tree& tree = robot.model.tree;
  Tick tick(tree, {});
  ComputeTick(tree, q, Eigen::VectorXd::Zero(tree.nv()), &tick);
  std::vector<Eigen::Vector2d> soles;
  double ground = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < robot.feet.size(); ++i) {
    const Foot& foot = robot.feet[i];
    const Pose X_WC = tick.X_WB[foot.body] * foot.X_BC;
    ground = std::min(ground, X_WC.p.z());
    if (!down.empty() && !down[i]) continue;
    for (const Eigen::Vector2d& corner : foot.polygon_C) {
      const Eigen::Vector3d p_WQ =
          X_WC * Eigen::Vector3d(corner.x(), corner.y(), 0);
      soles.push_back(p_WQ.head<2>());
    }
  }
  const Eigen::Vector3d com = tick.p_WG - ground * Eigen::Vector3d::UnitZ();
  const double push_height = (tick.X_WB[body] * p_BoQ_B).z() - ground;
  if (!(com.z() > 0 && push_height > 0)) return std::nullopt;
  return ComputeYardstick(tree.total_mass(), tree.gravity_W().norm(), com,
                          soles, u, duration, push_height);
}

}  // namespace poise
