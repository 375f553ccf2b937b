// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/cost_order.h"

#include <algorithm>
#include <cmath>

#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/tolerances.h"

namespace poise {
namespace {

struct Cost {
  double cost, size;  // Twice the cost of a level; squares of its terms.
};

const double* RowOfB(const Hierarchy& hierarchy, int level, int i) {
  return hierarchy.B(level).data() +
         static_cast<size_t>(i) * hierarchy.num_variables();
}

const double* RowOfC(const Hierarchy& hierarchy, int level, int i) {
  return hierarchy.C(level).data() +
         static_cast<size_t>(i) * hierarchy.num_variables();
}

Cost FindCost(const Hierarchy& hierarchy, int level,
              const std::vector<double>& y) {
  Cost sum = {0, 0};
  const auto product = [&](const double* row, const Span& span) {
    double value;
    kernels::SpanDots(row, hierarchy.num_variables(), &span, 1, y.data(),
                      &value);
    return value;
  };
  const auto b = hierarchy.b(level), weight = hierarchy.weight(level);
  for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
    const double value =
        product(RowOfB(hierarchy, level, i), hierarchy.B_span(level)[i]);
    const double residual = value + b[i];
    sum.cost += weight[i] * residual * residual;
    sum.size += weight[i] * (value * value + b[i] * b[i]);
  }
  const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
  for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
    const double value =
        product(RowOfC(hierarchy, level, i), hierarchy.C_span(level)[i]);
    const double slack = std::max({value - upper[i], lower[i] - value, 0.0});
    sum.cost += slack * slack;
    if (slack > 0) sum.size += value * value;
  }
  return sum;
}

// Returns twice the cost of a level that rounding of a point can cause, whose largest entry
// is `largest`. Where the terms of all rows cancel, this is more than rounding of the cost.
double CostOfRounding(const Hierarchy& hierarchy, int level, double largest) {
  const double rounding = tolerances::kSolutionRounding * largest;
  const auto square = [&](const double* row) {
    const double residual =
        rounding * kernels::AbsoluteSum(row, hierarchy.num_variables());
    return residual * residual;
  };
  double sum = 0;
  for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
    sum += hierarchy.weight(level)[i] * square(RowOfB(hierarchy, level, i));
  }
  for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
    sum += square(RowOfC(hierarchy, level, i));
  }
  return sum;
}

}  // namespace

bool IsBetter(const Hierarchy& hierarchy, const std::vector<double>& y,
              const std::vector<double>& other) {
  const int n = hierarchy.num_variables();
  const double largest = std::max(kernels::Largest(y.data(), n),
                                  kernels::Largest(other.data(), n));
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    const Cost cost = FindCost(hierarchy, level, y);
    const Cost than = FindCost(hierarchy, level, other);
    const double difference = std::abs(cost.cost - than.cost);
    if (difference > tolerances::kZeroSlope * std::max(cost.size, than.size) &&
        difference > CostOfRounding(hierarchy, level, largest)) {
      return cost.cost < than.cost;
    }
  }
  return false;
}

}  // namespace poise
