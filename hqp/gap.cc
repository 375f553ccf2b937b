// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Certifier, second part: the gap. Derivation: docs/hqp-gap.md.
#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/hqp/certificate.h"
#include "poise/hqp/tolerances.h"

namespace poise {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Terms of the gap below this part of the cost need no sharper bound, which
// takes longer: a hundredth of the gap of 1e-6 that a robot needs in every
// tick.
constexpr double kSharpEnough = 1e-8;

long double PreciseProduct(const double* row, Span span,
                           const Eigen::VectorXd& y) {
  long double sum = 0;
  for (int j = span.first; j < span.first + span.size; ++j) {
    sum += static_cast<long double>(row[j]) * y[j];
  }
  return sum;
}

// Rounding of a sum of n terms in long double: one for each addition, one for
// each product, and some for what follows, rounded up to 10.
double PreciseRounding(Eigen::Index n) {
  return static_cast<double>(std::numeric_limits<long double>::epsilon()) *
         static_cast<double>(n + 10);
}

// Computes the residuals and slacks of a level in long double, and calls
// add(row, span, gradient of the cost in row . y). An inequality i with
// is_inside(i) has no slack. Returns the cost.
template <typename IsInside, typename Add>
long double VisitPreciseSlacks(const Hierarchy& hierarchy, int level,
                               const Eigen::VectorXd& y,
                               const IsInside& is_inside, const Add& add) {
  long double cost = 0;
  for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
    const double* row = hierarchy.B(level).row(i).data();
    const Span span = hierarchy.B_span(level)[i];
    const long double residual =
        PreciseProduct(row, span, y) + hierarchy.b(level)[i];
    const long double force = hierarchy.weight(level)[i] * residual;
    cost += force * residual / 2;
    add(row, span, force);
  }
  for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
    if (is_inside(i)) continue;
    const double* row = hierarchy.C(level).row(i).data();
    const Span span = hierarchy.C_span(level)[i];
    const long double value = PreciseProduct(row, span, y);
    const long double above = value - hierarchy.upper(level)[i];
    const long double below = value - hierarchy.lower(level)[i];
    const long double slack = above > 0 ? above : below < 0 ? below : 0;
    cost += slack * slack / 2;
    add(row, span, slack);
  }
  return cost;
}

}  // namespace

// Returns the cost to which the gap of a level is relative.
double Certifier::CostScale(int level) const {
  return cost_[level] + tolerances::kZeroCost * cost_size_[level];
}

double Certifier::RelativeGap(int level) const {
  return gap_[level] == 0 ? 0 : gap_[level] / CostScale(level);
}

// See gap(). gradient_ is that of the level.
void Certifier::FindGap(const Hierarchy& hierarchy, int level,
                        const Solution& solution) {
  const double radius = 2 * (solution.y.norm() + farthest_);
  // One rounding for each term of an entry, and those of the residual in a
  // term.
  const auto n = static_cast<int>(gradient_.size());
  const double size = gradient_size_.norm();
  const double rounding = (num_terms_ + n / 4 + 10) * kEpsilon / 2 * size;
  const double cost = cost_[level];
  error_[level] = gradient_.norm() + rounding;
  FindNormsOfMultipliers(hierarchy, level, solution);
  double gap = cost;
  if (cost > kSharpEnough * CostScale(level)) {
    double gain = 0;
    for (int above = 0; above < level; ++above) {
      gain += LargestGain(hierarchy, level, above, radius, solution);
    }
    // If the gains are larger, a sharper gradient cannot halve the gap.
    if (rounding * radius > std::max(kSharpEnough * CostScale(level), gain)) {
      error_[level] = PreciseGradientNorm(hierarchy, level, solution) +
                      PreciseRounding(num_terms_ + n) * size;
    }
    gap = error_[level] * radius + gain;
    gap = std::isnan(gap) ? cost : std::min(gap, cost);
  }
  gap_[level] = exact_gap_[level] = gap + cost_rounding_[level];
  is_sharp_[level] = false;
  FindChange(level);
}

// Finds undercut_ and change_ of a level from those of the levels above. Half
// the squared change is at most the gap and the undercut together.
void Certifier::FindChange(int level) {
  undercut_[level] = 0;
  for (int above = 0; above < level; ++above) {
    undercut_[level] += multiplier_norm_(level, above) * change_[above];
  }
  change_[level] = std::sqrt(2 * (exact_gap_[level] + undercut_[level]));
}

// Computes the norm of the gradient of the level's Lagrangian in long double.
// Large multipliers cancel there.
double Certifier::PreciseGradientNorm(const Hierarchy& hierarchy, int level,
                                      const Solution& solution) {
  std::fill(precise_gradient_.begin(), precise_gradient_.end(), 0);
  const auto add = [&](const double* row, Span span, long double factor) {
    if (factor == 0) return;
    for (int j = span.first; j < span.first + span.size; ++j) {
      precise_gradient_[j] += factor * row[j];
    }
  };
  const auto is_inside = [&](int i) { return IsInside(level, i); };
  (void)VisitPreciseSlacks(hierarchy, level, solution.y, is_inside, add);
  for (int above = 0; above < level; ++above) {
    const LevelMultipliers& of = solution.levels[level].multipliers[above];
    for (int i = 0; i < hierarchy.num_equalities(above); ++i) {
      add(hierarchy.B(above).row(i).data(), hierarchy.B_span(above)[i],
          of.equality[i]);
    }
    for (int i = 0; i < hierarchy.num_inequalities(above); ++i) {
      add(hierarchy.C(above).row(i).data(), hierarchy.C_span(above)[i],
          of.inequality[i]);
    }
  }
  long double squares = 0;
  for (const long double entry : precise_gradient_) squares += entry * entry;
  return static_cast<double>(std::sqrt(squares));
}

// Returns whether an inequality has no slack in exact arithmetic. The rounding
// is that of the nearer bound. At the farther one, it is at most twice as
// large, but for a small part of the distance.
bool Certifier::IsInside(int level, int i) const {
  const Inequality& row = inequalities(level)[i];
  return row.violation < -3 * row.rounding;
}

// Sharpens change_ of the levels up to `level`: computes their costs in long
// double, and limits exact_gap_ to them. The cost of a level that is met is
// mostly rounding in double.
void Certifier::SharpenChanges(const Hierarchy& hierarchy, int level,
                               const Solution& solution) {
  for (int k = 0; k <= level; ++k) {
    if (is_sharp_[k]) continue;
    is_sharp_[k] = true;
    const double rounding =
        PreciseRounding(solution.y.size() + hierarchy.num_equalities(k) +
                        hierarchy.num_inequalities(k));
    const auto cost = static_cast<double>(VisitPreciseSlacks(
        hierarchy, k, solution.y, [&](int i) { return IsInside(k, i); },
        [](const double*, Span, long double) {}));
    const double root = std::sqrt(cost) + rounding * std::sqrt(cost_size_[k]);
    exact_gap_[k] = std::min(exact_gap_[k], root * root * (1 + 4 * kEpsilon));
    FindChange(k);
  }
}

// Finds multiplier_norm_ of a level.
void Certifier::FindNormsOfMultipliers(const Hierarchy& hierarchy, int level,
                                       const Solution& solution) {
  for (int above = 0; above < level; ++above) {
    const LevelMultipliers& of = solution.levels[level].multipliers[above];
    const auto weight = hierarchy.weight(above);
    double squares = 0;
    for (int i = 0, rows = hierarchy.num_equalities(above); i < rows; ++i) {
      const double lambda = of.equality[i];
      if (lambda != 0) squares += lambda * lambda / weight[i];
    }
    for (int i = 0, rows = hierarchy.num_inequalities(above); i < rows; ++i) {
      squares += of.inequality[i] * of.inequality[i];
    }
    multiplier_norm_(level, above) = std::sqrt(squares);
  }
}

// Largest lambda' B d + mu' C d of the rows of a level above.
double Certifier::LargestGain(const Hierarchy& hierarchy, int level, int above,
                              double radius, const Solution& solution) {
  const double norm = multiplier_norm_(level, above);
  if (norm == 0) return 0;
  const Eigen::VectorXd& mu =
      solution.levels[level].multipliers[above].inequality;
  const double norm_y = solution.y.norm();
  double gain = 0;
  for (int i = 0, rows = hierarchy.num_inequalities(above); i < rows; ++i) {
    if (mu[i] == 0) continue;
    gain +=
        FreeChange(hierarchy, level, above, i, mu[i], radius, norm_y, solution);
  }
  const double sharp_enough = kSharpEnough * CostScale(level);
  double of_slacks = norm * change_[above];
  if (of_slacks <= sharp_enough || std::isinf(norm)) return gain + of_slacks;
  SharpenChanges(hierarchy, above, solution);
  of_slacks = norm * change_[above];
  const auto sharpen = [&](const Eigen::VectorXd* p) {
    if (of_slacks <= sharp_enough) return;
    of_slacks =
        std::min(of_slacks, GainOfSlacks(hierarchy, level, above, p, solution));
  };
  sharpen(nullptr);
  const LevelSolution& of = solution.levels[level];
  if (of.traded_level == above) sharpen(&of.trade_off);
  return gain + of_slacks;
}

// Largest mu C_i d of row i of a level `above`, but for the change of its
// slack.
double Certifier::FreeChange(const Hierarchy& hierarchy, int level, int above,
                             int i, double mu, double radius, double norm_y,
                             const Solution& solution) const {
  const Inequality* rows = inequalities(above);
  // A row with a slack at the optimum as well changes with this slack only.
  if (rows[i].violation >
      tolerances::kAtBound * rows[i].size + change_[above]) {
    return 0;
  }
  const Span span = hierarchy.C_span(above)[i];
  const double bound =
      mu > 0 ? hierarchy.upper(above)[i] : hierarchy.lower(above)[i];
  const double side = mu > 0 ? 1 : -1;
  const double size =
      rows[i].norm * norm_y + (std::isinf(bound) ? 0 : std::abs(bound));
  double distance = side * (bound - rows[i].value);
  double rounding = RowSumRounding(span.size) * size;
  if (std::abs(mu) * rounding > kSharpEnough * CostScale(level)) {
    const long double value =
        PreciseProduct(hierarchy.C(above).row(i).data(), span, solution.y);
    distance = static_cast<double>(side * (bound - value));
    rounding = PreciseRounding(span.size) * size;
  }
  return std::abs(mu) *
         std::min(std::max(distance, 0.0) + rounding, rows[i].norm * radius);
}

// Finds sums_ along p of the equalities of a level, and then of its
// inequalities. Without p, they are zero.
void Certifier::FindSums(const Hierarchy& hierarchy, int level,
                         const Eigen::VectorXd* p) {
  const int n = hierarchy.num_variables();
  const int equalities = hierarchy.num_equalities(level);
  const int inequalities = hierarchy.num_inequalities(level);
  if (p == nullptr) {
    std::fill_n(sums_.begin(), equalities + inequalities, RowSums{});
    return;
  }
  SumRows(hierarchy.B(level).data(), n, hierarchy.B_span(level), equalities,
          p->data(), sums_.data());
  SumRows(hierarchy.C(level).data(), n, hierarchy.C_span(level), inequalities,
          p->data(), sums_.data() + equalities);
}

// Calls use(m, s, change, rounding, distance) for the rows of level `above`:
// the multiplier m that `level` puts on the row, divided by the root of the
// row's weight; its residual or slack s and the change of s along p, with the
// rounding of the latter, times the root; and the distance of an inactive row
// from its bounds, else 0. pre: FindSums().
template <typename Use>
void Certifier::ForEachSlack(const Hierarchy& hierarchy, int level, int above,
                             const Solution& solution, const Use& use) const {
  const LevelMultipliers& multipliers =
      solution.levels[level].multipliers[above];
  const Inequality* rows = inequalities(above);
  const int equalities = hierarchy.num_equalities(above);
  for (int i = 0; i < equalities; ++i) {
    const double root = std::sqrt(hierarchy.weight(above)[i]);
    if (root == 0) continue;
    const RowSums& sums = sums_[i];
    const double rounding = RowSumRounding(hierarchy.B_span(above)[i].size);
    use(multipliers.equality[i] / root, root * residual_[above][i],
        root * sums.product, root * rounding * sums.product_size, 0);
  }
  for (int i = 0; i < hierarchy.num_inequalities(above); ++i) {
    const double slack = std::max(rows[i].violation, 0.0);
    const double mu = multipliers.inequality[i];
    const bool is_inactive = slack == 0 && mu == 0;
    const RowSums& sums = sums_[equalities + i];
    const double rounding = RowSumRounding(hierarchy.C_span(above)[i].size);
    use(mu, rows[i].side == Side::kUpper ? slack : -slack, sums.product,
        rounding * sums.product_size, is_inactive ? -rows[i].violation : 0);
  }
}

// Largest sum of m_i times the change of s_i, the residuals and slacks of a
// level above, with m = J p + f s + rest, see ForEachSlack(). Without p, J p is
// zero. Infinite if the levels above do not allow a step along p.
double Certifier::GainOfSlacks(const Hierarchy& hierarchy, int level, int above,
                               const Eigen::VectorXd* p,
                               const Solution& solution) {
  double slope = 0, longest = kInfinity;
  if (p != nullptr) {
    longest = LargestStep(hierarchy, above, *p, solution, &slope);
    if (longest == 0) return kInfinity;
  }
  FindSums(hierarchy, above, p);
  double along = 0, squares = 0;
  ForEachSlack(hierarchy, level, above, solution,
               [&](double m, double s, double change, double, double) {
                 along += (m - change) * s;
                 squares += s * s;
               });
  const double gap = exact_gap_[above], undercut = undercut_[above];
  const auto gain = [&](double f) {
    double step = longest, rest_squares = 0;
    ForEachSlack(hierarchy, level, above, solution,
                 [&](double m, double s, double change, double rounding,
                     double distance) {
                   const double rest =
                       std::abs(m - change - f * s) + rounding +
                       kEpsilon * (std::abs(m) + std::abs(change));
                   if (distance > 0) {
                     step = std::min(step, distance / rest);
                   } else {
                     rest_squares += rest * rest;
                   }
                 });
    // The slope is counted twice: once for the cost, and once for what y - t p
    // misses above, because its rows change along p by rounding.
    const double of_p = p == nullptr ? 0 : (gap + undercut) / step + 2 * slope;
    const double of_s = f > 0 ? f * undercut : -f * (2 * gap + undercut);
    const double rounding = std::abs(f) * slack_rounding_[above];
    return of_p + of_s + (std::sqrt(rest_squares) + rounding) * change_[above];
  };
  // If the level is met, s is rounding.
  const double without_s = gain(0);
  return squares > 0 ? std::min(without_s, gain(along / squares)) : without_s;
}

// Returns the largest t for which y - t p keeps the levels above `level` as
// they are, or 0 if no step does. Sets `slope` to an upper bound of |g . p|,
// where g is the gradient of the cost of `level`.
double Certifier::LargestStep(const Hierarchy& hierarchy, int level,
                              const Eigen::VectorXd& p,
                              const Solution& solution, double* slope) const {
  const double norm_p = p.norm();
  double step = kInfinity;
  *slope = error_[level] * norm_p;
  for (int above = 0; above < level; ++above) {
    const LevelMultipliers& of = solution.levels[level].multipliers[above];
    const auto change = [&](const double* row, Span span, double multiplier) {
      const RowSums sums = SumRow(row, span, p.data());
      *slope += std::abs(multiplier) *
                (std::abs(sums.product) +
                 RowSumRounding(span.size) * sums.product_size);
      return sums;
    };
    // A row that must not change may change by rounding of the solver.
    const auto changes = [&](double along_p, double norm) {
      return std::abs(along_p) > tolerances::kAtBound * norm * norm_p;
    };
    for (int i = 0; i < hierarchy.num_equalities(above); ++i) {
      if (hierarchy.weight(above)[i] == 0) continue;
      const RowSums sums = change(hierarchy.B(above).row(i).data(),
                                  hierarchy.B_span(above)[i], of.equality[i]);
      if (changes(sums.product, std::sqrt(sums.squared_row_norm))) return 0;
    }
    const Inequality* rows = inequalities(above);
    for (int i = 0; i < hierarchy.num_inequalities(above); ++i) {
      const double along_p =
          change(hierarchy.C(above).row(i).data(), hierarchy.C_span(above)[i],
                 of.inequality[i])
              .product;
      const double margin = tolerances::kAtBound * rows[i].size;
      const bool is_inside = rows[i].violation < -margin;
      if (along_p == 0 || (!is_inside && !changes(along_p, rows[i].norm))) {
        continue;
      }
      const double distance = along_p < 0
                                  ? hierarchy.upper(above)[i] - rows[i].value
                                  : rows[i].value - hierarchy.lower(above)[i];
      if (distance <= 0 || rows[i].violation > margin) return 0;
      step = std::min(step, distance / std::abs(along_p));
    }
  }
  return step;
}

}  // namespace poise
