// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/solution.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/hqp/fast/kernels.h"

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
    level.trade_off.setZero(num_variables);
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
    level.gap = std::numeric_limits<double>::infinity();
    level.equality_residual.setZero();
    level.slack.setZero();
    std::fill(level.active.begin(), level.active.end(), Side::kNone);
    level.nullity = static_cast<int>(y.size());
    level.traded_level = -1;
    for (LevelMultipliers& multipliers : level.multipliers) {
      multipliers.equality.setZero();
      multipliers.inequality.setZero();
    }
  }
}

void Solution::Reset(const Hierarchy& hierarchy) noexcept {
  status = Status::kOptimal;
  failed_level = -1;
  iterations = 0;
  y.setZero();
  certificate = {};
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    const int equalities = hierarchy.num_equalities(k);
    const int inequalities = hierarchy.num_inequalities(k);
    LevelSolution& level = levels[k];
    level.cost = 0;
    level.gap = std::numeric_limits<double>::infinity();
    level.equality_residual.head(equalities).setZero();
    level.slack.head(inequalities).setZero();
    std::fill_n(level.active.begin(), inequalities, Side::kNone);
    level.nullity = static_cast<int>(y.size());
    level.traded_level = -1;
    for (int below = k + 1; below < hierarchy.num_levels(); ++below) {
      LevelMultipliers& multipliers = levels[below].multipliers[k];
      multipliers.equality.head(equalities).setZero();
      multipliers.inequality.head(inequalities).setZero();
    }
  }
}

void EvaluateLevel(const Hierarchy& hierarchy, int level,
                   Solution* solution) noexcept {
  const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
  LevelSolution& out = solution->levels[level];
  auto residual = out.equality_residual.head(hierarchy.num_equalities(level));
  auto slack = out.slack.head(hierarchy.num_inequalities(level));
  kernels::SpanDots(hierarchy.B(level).data(), hierarchy.num_variables(),
                    hierarchy.B_span(level), hierarchy.num_equalities(level),
                    solution->y.data(), residual.data());
  residual += hierarchy.b(level);
  kernels::SpanDots(hierarchy.C(level).data(), hierarchy.num_variables(),
                    hierarchy.C_span(level), hierarchy.num_inequalities(level),
                    solution->y.data(), slack.data());
  slack = (lower - slack).cwiseMax(slack - upper).cwiseMax(0);
  out.cost = (residual.cwiseAbs2().dot(hierarchy.weight(level)) +
              slack.squaredNorm()) /
             2;
}

Status CheckInput(const Hierarchy& hierarchy, int* failed_level) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    *failed_level = level;
    // A product with 0 is NaN if a factor is NaN or infinite.
    double zero = 0;
    const auto square = [](const auto& row) {
      const double norm = row.template lpNorm<1>();
      return norm * norm;
    };
    for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
      const double weight = hierarchy.weight(level)[i];
      const double size = square(hierarchy.B(level).row(i)) * weight;
      zero += size * 0 + hierarchy.b(level)[i] * 0 + weight * 0;
    }
    for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
      zero += square(hierarchy.C(level).row(i)) * 0;
    }
    if (zero != 0) return Status::kNotFinite;
    bool in_order = true;
    for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
      const double lower = hierarchy.lower(level)[i];
      const double upper = hierarchy.upper(level)[i];
      if (std::isnan(lower) || std::isnan(upper) || lower == kInfinity ||
          upper == -kInfinity) {
        return Status::kNotFinite;
      }
      in_order &= lower <= upper;
    }
    if (!in_order) return Status::kBadInput;
    for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
      if (hierarchy.weight(level)[i] < 0) return Status::kBadInput;
    }
  }
  *failed_level = -1;
  return Status::kOptimal;
}

}  // namespace poise
