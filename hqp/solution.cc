// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/solution.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poise {

double Certificate::worst() const noexcept {
  double worst = 0;
  for (double each : {stationarity, feasibility, complementarity, priority}) {
    if (std::isnan(each)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, each);
  }
  return worst;
}

Solution::Solution(int num_variables,
                   const std::vector<LevelCapacity>& capacity)
    : y(num_variables) {
  for (const LevelCapacity& rows : capacity) {
    LevelSolution level;
    level.equality_residual.resize(rows.equalities);
    level.slack.resize(rows.inequalities);
    level.active.resize(rows.inequalities);
    for (size_t above = 0; above < levels.size(); ++above) {
      level.multipliers.push_back(
          {Eigen::VectorXd(capacity[above].equalities),
           Eigen::VectorXd(capacity[above].inequalities)});
    }
    levels.push_back(std::move(level));
  }
  Reset();
}

void Solution::Reset() noexcept {
  status = Status::kOptimal;
  failed_level = -1;
  iterations = 0;
  y.setZero();
  certificate = {};
  for (LevelSolution& level : levels) {
    level.cost = 0;
    level.equality_residual.setZero();
    level.slack.setZero();
    std::fill(level.active.begin(), level.active.end(), Side::kNone);
    level.nullity = static_cast<int>(y.size());
    for (LevelMultipliers& multipliers : level.multipliers) {
      multipliers.equality.setZero();
      multipliers.inequality.setZero();
    }
  }
}

void EvaluateLevel(const Hierarchy& hierarchy, int level,
                   Solution* solution) noexcept {
  const int equalities = hierarchy.num_equalities(level);
  const int inequalities = hierarchy.num_inequalities(level);
  LevelSolution& out = solution->levels[level];
  out.cost = 0;
  for (int i = 0; i < equalities; ++i) {
    const double residual =
        hierarchy.B(level).row(i).dot(solution->y) + hierarchy.b(level)[i];
    out.equality_residual[i] = residual;
    out.cost += hierarchy.weight(level)[i] * residual * residual / 2;
  }
  for (int i = 0; i < inequalities; ++i) {
    const double value = hierarchy.C(level).row(i).dot(solution->y);
    out.slack[i] = std::max({hierarchy.lower(level)[i] - value,
                             value - hierarchy.upper(level)[i], 0.0});
    out.cost += out.slack[i] * out.slack[i] / 2;
  }
}

Status CheckInput(const Hierarchy& hierarchy, int* failed_level) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    *failed_level = level;
    // A sum over the block is NaN if any entry is NaN or infinite.
    const auto is_finite = [](const auto& block) {
      return std::isfinite((block.array() * 0).sum());
    };
    if (!is_finite(hierarchy.B(level)) || !is_finite(hierarchy.b(level)) ||
        !is_finite(hierarchy.weight(level)) || !is_finite(hierarchy.C(level))) {
      return Status::kNotFinite;
    }
    for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
      const double lower = hierarchy.lower(level)[i];
      const double upper = hierarchy.upper(level)[i];
      if (std::isnan(lower) || std::isnan(upper) || lower == kInfinity ||
          upper == -kInfinity) {
        return Status::kNotFinite;
      }
      if (lower > upper) return Status::kBadInput;
    }
    for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
      if (hierarchy.weight(level)[i] < 0) return Status::kBadInput;
    }
  }
  *failed_level = -1;
  return Status::kOptimal;
}

}  // namespace poise
