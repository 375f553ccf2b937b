// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/lexicographic.h"

#include <algorithm>
#include <random>

#include "poise/tests/util/decompositions.h"

namespace poise {
namespace {

// Singular values below this are zero. It is far above the rounding error of
// dependent rows, and far below the singular values of the independent rows
// that MakeRandomLevels() draws.
constexpr double kRankThreshold = 1e-9;

}  // namespace

void AppendRow(const Eigen::RowVectorXd& row, double target,
               LeastSquares* level) {
  const auto end = level->A.rows();
  level->A.conservativeResize(end + 1, row.size());
  level->b.conservativeResize(end + 1);
  level->weight.conservativeResize(end + 1);
  level->A.row(end) = row;
  level->b[end] = target;
  level->weight[end] = 1;
}

LexicographicOptimum SolveLexicographically(
    int num_variables, const std::vector<LeastSquares>& levels) {
  LexicographicOptimum optimum;
  optimum.y.setZero(num_variables);
  Eigen::MatrixXd N =
      Eigen::MatrixXd::Identity(num_variables, num_variables);  // Nullspace.
  for (const LeastSquares& level : levels) {
    if (N.cols() > 0 && level.A.rows() > 0) {
      const Eigen::VectorXd d = level.weight.cwiseSqrt();
      const JacobiSvd svd(d.asDiagonal() * level.A * N);
      const Eigen::VectorXd& sigma = svd.sigma;
      int rank = 0;
      while (rank < sigma.size() && sigma[rank] > kRankThreshold) ++rank;
      const Eigen::VectorXd rest =
          d.asDiagonal() * (level.b - level.A * optimum.y);
      const Eigen::VectorXd z = (svd.U.leftCols(rank).transpose() * rest)
                                    .cwiseQuotient(sigma.head(rank));
      optimum.y += N * (svd.V.leftCols(rank) * z);
      N = (N * svd.V.rightCols(N.cols() - rank)).eval();
      if (rank > 0) {
        optimum.condition =
            std::max({optimum.condition, sigma[0] / sigma[rank - 1],
                      1 / sigma[rank - 1]});
      }
    }
    optimum.rank.push_back(num_variables - static_cast<int>(N.cols()));
  }
  return optimum;
}

std::vector<LeastSquares> MakeRandomLevels(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto below = [&](int bound) {
    return static_cast<int>(random() % static_cast<unsigned>(bound));
  };
  const auto number = [&] { return (below(2001) - 1000) / 1000.0; };
  const int n = 1 + below(9);
  std::vector<LeastSquares> levels(1 + below(4));
  std::vector<Eigen::VectorXd> rows;
  for (LeastSquares& level : levels) {
    const int count = below(7);
    level.A.resize(count, n);
    level.b.resize(count);
    level.weight.resize(count);
    for (int i = 0; i < count; ++i) {
      Eigen::VectorXd row(n);
      do {
        row = Eigen::VectorXd::NullaryExpr(n, number);
        if (!rows.empty() && below(3) == 0) {
          const auto size = static_cast<int>(rows.size());
          row = rows[below(size)] + (below(3) - 1) * rows[below(size)];
        }
      } while (row.norm() < 0.01);
      row.normalize();
      rows.push_back(row);
      level.A.row(i) = row;
      level.b[i] = 10 * number();
      level.weight[i] = 1 + 10 * std::abs(number());
    }
  }
  return levels;
}

}  // namespace poise
