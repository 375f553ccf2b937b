// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The solver alone: a planar arm reaches a point under limits of its rates.
#include <Eigen/Geometry>
#include <iostream>
#include <vector>

#include "poise/hqp/solver.h"

int main() {
  constexpr double kDt = 0.01, kMaxRate = 0.8;            // s, rad/s.
  Eigen::Vector2d link(0.4, 0), target(0.3, 0.7), error;  // m.
  Eigen::Vector3d q(0.1, 0.2, 0.3);
  const std::vector<poise::LevelCapacity> levels = {{0, 3}, {2, 0}, {3, 0}};
  poise::Hierarchy hierarchy(3, levels);
  poise::Solver solver(3, levels);
  poise::Solution solution(3, levels);
  for (int tick = 0; tick < 400; ++tick) {  // 4 s: 20 time constants.
    Eigen::Matrix<double, 2, 3> J = J.Zero();
    error = target;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d r = Eigen::Rotation2Dd(q.head(i + 1).sum()) * link;
      error -= r;
      J.leftCols(i + 1).colwise() += Eigen::Vector2d(-r.y(), r.x());
    }
    hierarchy.Clear(3);
    poise::InequalityBlock rates = hierarchy.AddInequalities(0, 3);
    rates.C.setIdentity();
    rates.lower.setConstant(-kMaxRate);
    rates.upper.setConstant(kMaxRate);
    poise::EqualityBlock reach = hierarchy.AddEqualities(1, 2);
    reach.B = J;  // J qdot = 5 error.
    reach.b = -5 * error;
    hierarchy.AddEqualities(2, 3).B.setIdentity();  // Small joint rates.
    if (solver.Solve(hierarchy, &solution) != poise::Status::kOptimal) return 1;
    if (solution.y.lpNorm<Eigen::Infinity>() > kMaxRate + 1e-12) return 2;
    q += kDt * solution.y;
  }
  std::cout << "error " << error.norm() << " m\n";
  return error.norm() < 1e-6 ? 0 : 3;  // e^-20 is 2e-9.
}
