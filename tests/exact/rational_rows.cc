// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/exact/rational_rows.h"

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>
#include <string>

#include "poise/hqp/solution.h"

namespace poise {
namespace {

RationalVector Exact(const Eigen::VectorXd& from) {
  return RationalVector(from.data(), from.data() + from.size());
}

std::optional<Rational> ExactBound(double bound) {
  if (std::isinf(bound)) return std::nullopt;
  return Rational(bound);
}

RationalRows ExactLevel(const Hierarchy& hierarchy, int level) {
  RationalRows rows;
  for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
    rows.B.push_back(Exact(hierarchy.B(level).row(i)));
  }
  rows.b = Exact(hierarchy.b(level));
  rows.weight = Exact(hierarchy.weight(level));
  for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
    rows.C.push_back(Exact(hierarchy.C(level).row(i)));
    rows.lower.push_back(ExactBound(hierarchy.lower(level)[i]));
    rows.upper.push_back(ExactBound(hierarchy.upper(level)[i]));
  }
  return rows;
}

RationalRows MinimumNorm(int num_variables) {
  const Eigen::MatrixXd identity =
      Eigen::MatrixXd::Identity(num_variables, num_variables);
  RationalRows rows;
  for (int j = 0; j < num_variables; ++j) {
    rows.B.push_back(Exact(identity.row(j)));
  }
  rows.b.assign(num_variables, 0);
  rows.weight.assign(num_variables, 1);
  return rows;
}

}  // namespace

std::vector<RationalRows> MakeRationalRows(const Hierarchy& hierarchy) {
  int failed_level;
  if (CheckInput(hierarchy, &failed_level) != Status::kOptimal) {
    throw std::invalid_argument(
        "level " + std::to_string(failed_level) +
        " has a number that is not finite, crossed bounds or a negative "
        "weight; correct the level");
  }
  std::vector<RationalRows> levels;
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    levels.push_back(ExactLevel(hierarchy, k));
  }
  levels.push_back(MinimumNorm(hierarchy.num_variables()));
  return levels;
}

Rational Violation(const RationalRows& rows, int i, const RationalVector& y) {
  const Rational value = Dot(rows.C[i], y);
  if (rows.upper[i] && value > *rows.upper[i]) return value - *rows.upper[i];
  if (rows.lower[i] && value < *rows.lower[i]) return value - *rows.lower[i];
  return 0;
}

Rational CostAt(const RationalRows& rows, const RationalVector& y) {
  Rational sum = 0;
  for (size_t i = 0; i < rows.B.size(); ++i) {
    const Rational residual = Dot(rows.B[i], y) + rows.b[i];
    sum += rows.weight[i] * residual * residual;
  }
  for (size_t i = 0; i < rows.C.size(); ++i) {
    const Rational violation = Violation(rows, static_cast<int>(i), y);
    sum += violation * violation;
  }
  return sum / 2;
}

}  // namespace poise
