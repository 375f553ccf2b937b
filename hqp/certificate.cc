// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/hqp/tolerances.h"

namespace poise {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double Ratio(double error, double size) {
  return error == 0 ? 0 : std::abs(error) / size;
}

// Returns the larger one, or infinity if either is NaN.
double Worse(double a, double b) {
  return std::isnan(a) || std::isnan(b) ? kInfinity : std::max(a, b);
}

// Returns the largest absolute entry of a row.
double Largest(const double* row, int n) {
  return n == 0 ? 0 : Eigen::VectorXd::Map(row, n).lpNorm<Eigen::Infinity>();
}

int NumInequalities(const std::vector<LevelCapacity>& capacity) {
  int sum = 0;
  for (const LevelCapacity& level : capacity) sum += level.inequalities;
  return sum;
}

}  // namespace

Certifier::Certifier(int num_variables,
                     const std::vector<LevelCapacity>& capacity)
    : Certifier(num_variables, capacity, NumInequalities(capacity)) {}

Certifier::Certifier(int num_variables,
                     const std::vector<LevelCapacity>& capacity,
                     int max_inequalities)
    : inequalities_(max_inequalities),
      first_inequality_(capacity.size()),
      cost_(capacity.size()),
      cost_size_(capacity.size()),
      cost_rounding_(capacity.size()),
      slack_rounding_(capacity.size()),
      error_(capacity.size()),
      gap_(capacity.size()),
      exact_gap_(capacity.size()),
      undercut_(capacity.size()),
      change_(capacity.size()),
      multiplier_norm_(capacity.size(), capacity.size()),
      is_sharp_(capacity.size()),
      gradient_(num_variables),
      gradient_size_(num_variables),
      precise_gradient_(num_variables) {
  int most_rows = 0, most_sums = 0;
  for (const LevelCapacity& level : capacity) {
    most_rows = std::max({most_rows, level.equalities, level.inequalities});
    most_sums = std::max(most_sums, level.equalities + level.inequalities);
    residual_.emplace_back(level.equalities);
  }
  sums_.resize(most_sums);
  factor_.resize(most_rows);
  size_.resize(most_rows);
}

Certificate Certifier::Certify(const Hierarchy& hierarchy,
                               const Solution& solution) noexcept {
  std::fill(gap_.begin(), gap_.end(), kInfinity);
  farthest_ = 0;
  Certificate certificate;
  const int levels = solution.failed_level < 0 ? hierarchy.num_levels()
                                               : solution.failed_level;
  for (int level = 0; level < levels; ++level) {
    JudgeLevel(hierarchy, level, solution, &certificate);
    FindGap(hierarchy, level, solution);
    certificate.relative_gap =
        Worse(certificate.relative_gap, RelativeGap(level));
  }
  return certificate;
}

void Certifier::Certify(const Hierarchy& hierarchy,
                        Solution* solution) noexcept {
  solution->certificate =
      Certify(hierarchy, static_cast<const Solution&>(*solution));
  StoreGaps(hierarchy.num_levels(), solution);
}

void Certifier::StoreGaps(int num_levels, Solution* solution) const {
  for (int level = 0; level < num_levels; ++level) {
    solution->levels[level].gap = gap_[level];
  }
}

void Certifier::Truncate(const Hierarchy& hierarchy,
                         Solution* solution) noexcept {
  std::fill(gap_.begin(), gap_.end(), kInfinity);
  farthest_ = 0;
  solution->certificate = {};
  int levels = hierarchy.num_levels();
  if (solution->failed_level >= 0) {
    levels = std::min(levels, solution->failed_level + 1);
  }
  for (int level = 0; level < levels; ++level) {
    Certificate certificate = solution->certificate;
    JudgeLevel(hierarchy, level, *solution, &certificate);
    const bool is_certified =
        level != solution->failed_level && certificate.worst() <= kCertified;
    if (is_certified) {
      FindGap(hierarchy, level, *solution);
      solution->certificate = certificate;
      solution->certificate.relative_gap =
          Worse(certificate.relative_gap, RelativeGap(level));
    } else {
      // Multipliers that are not certified bound nothing.
      gap_[level] = cost_[level] + cost_rounding_[level];
    }
    if (is_certified) continue;
    solution->status = Status::kIterationLimit;
    solution->failed_level = level;
    break;
  }
  StoreGaps(hierarchy.num_levels(), solution);
}

void Certifier::JudgeLevel(const Hierarchy& hierarchy, int level,
                           const Solution& solution, Certificate* certificate) {
  JudgeRows(hierarchy, level, solution, certificate);
  JudgeMultipliers(hierarchy, level, solution, certificate);
}

// Adds factor_ times the rows of a block to the gradient, and |size_| times
// their absolute entries to the magnitude of the gradient's terms.
void Certifier::AddToGradient(const double* rows, const Span* spans,
                              int count) {
  num_terms_ += AddRowsWithSizes(rows, static_cast<int>(gradient_.size()),
                                 spans, count, factor_.data(), size_.data(),
                                 gradient_.data(), gradient_size_.data());
}

void Certifier::JudgeRows(const Hierarchy& hierarchy, int level,
                          const Solution& solution, Certificate* certificate) {
  gradient_.setZero();
  gradient_size_.setZero();
  num_terms_ = 0;
  const int n = hierarchy.num_variables();
  const int equalities = hierarchy.num_equalities(level);
  const int inequalities = hierarchy.num_inequalities(level);
  // A wrong span would hide entries from the solver as well, so the certificate
  // does not trust spans.
  const bool has_right_spans =
      AreZeroOutside(hierarchy.B(level).data(), n, hierarchy.B_span(level),
                     equalities) &&
      AreZeroOutside(hierarchy.C(level).data(), n, hierarchy.C_span(level),
                     inequalities);
  CostSums sums;
  JudgeEqualities(hierarchy, level, solution, &sums);
  JudgeInequalities(hierarchy, level, solution, &sums);
  slack_rounding_[level] = std::sqrt(sums.slack_rounding);
  cost_[level] = sums.cost;
  cost_size_[level] = sums.size;
  cost_rounding_[level] =
      sums.rounding + (equalities + inequalities + 2) * kEpsilon * sums.cost;
  certificate->feasibility =
      has_right_spans ? Worse(certificate->feasibility, sums.feasibility)
                      : kInfinity;
  certificate->priority =
      Worse(certificate->priority,
            Ratio(sums.cost - solution.levels[level].cost,
                  sums.cost + tolerances::kZeroCost * sums.size));
}

void Certifier::JudgeEqualities(const Hierarchy& hierarchy, int level,
                                const Solution& solution, CostSums* total) {
  const auto B = hierarchy.B(level);
  const auto b = hierarchy.b(level), weight = hierarchy.weight(level);
  const Span* spans = hierarchy.B_span(level);
  const int count = hierarchy.num_equalities(level);
  CostSums level_sums = *total;
  SumRows(B.data(), hierarchy.num_variables(), spans, count, solution.y.data(),
          sums_.data());
  for (int i = 0; i < count; ++i) {
    const RowSums& sums = sums_[i];
    const double residual = sums.product + b[i];
    const double size = sums.product_size + std::abs(b[i]);
    residual_[level][i] = residual;
    // The terms of such a row would hide those of all others.
    if (std::isinf(weight[i] * sums.squared_row_norm)) {
      level_sums.feasibility = kInfinity;
    }
    if (weight[i] > 0 && sums.squared_row_norm > 0) {
      farthest_ = std::max(farthest_,
                           std::abs(b[i]) / std::sqrt(sums.squared_row_norm));
    }
    level_sums.feasibility = Worse(
        level_sums.feasibility,
        Ratio(residual - solution.levels[level].equality_residual[i], size));
    level_sums.cost += weight[i] * residual * residual / 2;
    level_sums.size += weight[i] * size * size / 2;
    const double rounding = RowSumRounding(spans[i].size) * size;
    level_sums.rounding +=
        weight[i] * (std::abs(residual) + rounding / 2) * rounding;
    level_sums.slack_rounding += weight[i] * rounding * rounding;
    factor_[i] = weight[i] * residual;
    size_[i] = weight[i] * size;
  }
  *total = level_sums;
  AddToGradient(B.data(), spans, count);
}

void Certifier::JudgeInequalities(const Hierarchy& hierarchy, int level,
                                  const Solution& solution, CostSums* total) {
  const auto C = hierarchy.C(level);
  const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
  const Span* spans = hierarchy.C_span(level);
  const int count = hierarchy.num_inequalities(level);
  const double norm_y = solution.y.norm();
  first_inequality_[level] = level == 0
                                 ? 0
                                 : first_inequality_[level - 1] +
                                       hierarchy.num_inequalities(level - 1);
  Inequality* rows = inequalities_.data() + first_inequality_[level];
  CostSums level_sums = *total;
  SumRows(C.data(), hierarchy.num_variables(), spans, count, solution.y.data(),
          sums_.data());
  for (int i = 0; i < count; ++i) {
    const RowSums& sums = sums_[i];
    const double value = sums.product;
    const bool at_upper = value - upper[i] >= lower[i] - value;
    const double bound = at_upper ? upper[i] : lower[i];
    const double violation = at_upper ? value - bound : bound - value;
    const double size =
        std::isinf(bound) ? 0 : sums.product_size + std::abs(bound);
    rows[i].value = value;
    rows[i].norm = std::sqrt(sums.squared_row_norm);
    rows[i].side = at_upper ? Side::kUpper : Side::kLower;
    rows[i].violation = violation;
    rows[i].size =
        std::isinf(bound) ? 0 : rows[i].norm * norm_y + std::abs(bound);
    const double slack = std::max(violation, 0.0);
    level_sums.feasibility =
        Worse(level_sums.feasibility,
              Ratio(slack - solution.levels[level].slack[i], size));
    level_sums.cost += slack * slack / 2;
    level_sums.size += size * size / 2;
    const double rounding = RowSumRounding(spans[i].size) * size;
    rows[i].rounding = rounding;
    level_sums.rounding += (slack + rounding / 2) * rounding;
    level_sums.slack_rounding += rounding * rounding;
    // The margin of such a row would be infinite, and no multiplier on it
    // wrong.
    if (std::isinf(rows[i].norm)) level_sums.feasibility = kInfinity;
    if (violation > 0 && rows[i].norm > 0) {
      farthest_ = std::max(farthest_, std::abs(bound) / rows[i].norm);
    }
    factor_[i] = at_upper ? slack : -slack;
    size_[i] = violation > 0 ? size : 0;
  }
  *total = level_sums;
  AddToGradient(C.data(), spans, count);
}

void Certifier::JudgeMultipliers(const Hierarchy& hierarchy, int level,
                                 const Solution& solution,
                                 Certificate* certificate) {
  double worst = 0;  // Largest multiplier of the wrong sign.
  for (int above = 0; above < level; ++above) {
    const LevelMultipliers& multipliers =
        solution.levels[level].multipliers[above];
    const Inequality* rows = inequalities(above);
    const auto B = hierarchy.B(above), C = hierarchy.C(above);
    const auto weight = hierarchy.weight(above);
    for (int i = 0; i < B.rows(); ++i) {
      const double lambda = multipliers.equality[i];
      factor_[i] = size_[i] = lambda;
      // A row of weight 0 does not bind the levels below.
      if (lambda != 0 && weight[i] == 0) {
        const Span span = hierarchy.B_span(above)[i];
        const double* row = B.row(i).data() + span.first;
        worst = Worse(worst, std::abs(lambda) * Largest(row, span.size));
      }
    }
    AddToGradient(B.data(), hierarchy.B_span(above),
                  static_cast<int>(B.rows()));
    for (int i = 0; i < C.rows(); ++i) {
      const double mu = multipliers.inequality[i];
      factor_[i] = size_[i] = mu;
      if (mu == 0) continue;
      const Span span = hierarchy.C_span(above)[i];
      const double* row = C.row(i).data() + span.first;
      const double margin = tolerances::kAtBound * rows[i].size;
      double wrong;
      if (rows[i].violation > margin) {
        wrong = 0;
      } else if (rows[i].violation < -margin) {
        wrong = std::abs(mu);
      } else if (hierarchy.upper(above)[i] - hierarchy.lower(above)[i] <=
                 margin) {
        wrong = 0;  // The row is at both bounds: an equality.
      } else {
        wrong = rows[i].side == Side::kUpper ? -mu : mu;
      }
      worst = Worse(worst, std::max(wrong, 0.0) * Largest(row, span.size));
    }
    AddToGradient(C.data(), hierarchy.C_span(above),
                  static_cast<int>(C.rows()));
  }
  const double size = gradient_size_.lpNorm<Eigen::Infinity>();
  const double gradient =
      gradient_.size() > 0
          ? gradient_.cwiseAbs().maxCoeff<Eigen::PropagateNaN>()
          : 0;
  certificate->stationarity =
      Worse(certificate->stationarity, Ratio(gradient, size));
  certificate->complementarity =
      Worse(certificate->complementarity, Ratio(worst, size));
}

}  // namespace poise
