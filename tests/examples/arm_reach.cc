// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The solver alone: a planar arm with three joints reaches a point under limits
// of its joint rates. The example of docs/hqp.md.
#include <cmath>
#include <iostream>

#include "poise/hqp/solver.h"

int main() {
  constexpr int kJoints = 3;
  constexpr double kLink = 0.4, kDt = 0.01, kMaxRate = 0.8;  // m, s, rad/s.
  const Eigen::Vector2d target(0.3, 0.7);
  Eigen::Vector3d q(0.1, 0.2, 0.3);
  // Rows per level: {equalities, inequalities}.
  const std::vector<poise::LevelCapacity> levels = {{0, 3}, {2, 0}, {3, 0}};
  poise::Hierarchy hierarchy(kJoints, levels);
  poise::Solver solver(kJoints, levels);
  poise::Solution solution(kJoints, levels);
  double error = 0;
  for (int tick = 0; tick < 400; ++tick) {
    Eigen::Vector2d hand(0, 0);
    Eigen::Matrix<double, 2, 3> J = J.Zero();
    for (int link = 0; link < kJoints; ++link) {
      const double angle = q.head(link + 1).sum();
      hand += kLink * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      J.leftCols(link + 1).colwise() +=
          kLink * Eigen::Vector2d(-std::sin(angle), std::cos(angle));
    }
    error = (target - hand).norm();
    hierarchy.Clear(3);
    poise::InequalityBlock rates = hierarchy.AddInequalities(0, 3);
    rates.C.setIdentity();
    rates.lower.setConstant(-kMaxRate);
    rates.upper.setConstant(kMaxRate);
    poise::EqualityBlock reach = hierarchy.AddEqualities(1, 2);
    reach.B = J;  // J qdot = 5 (target - hand).
    reach.b = -5 * (target - hand);
    hierarchy.AddEqualities(2, 3).B.setIdentity();  // Small joint rates.
    if (solver.Solve(hierarchy, &solution) != poise::Status::kOptimal) return 1;
    if (solution.y.lpNorm<Eigen::Infinity>() > kMaxRate + 1e-12) return 2;
    q += kDt * solution.y;
  }
  std::cout << "error " << error << " m\n";
  return error < 1e-6 ? 0 : 3;  // 4 s are 20 time constants: e^-20 is 2e-9.
}
