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

// Calls use(i, r_i y) for `count` rows, n entries apart.
template <typename Use>
void ForEachProduct(const double* rows, int n, const Span* spans, int count,
                    const std::vector<double>& y, const Use& use) {
  constexpr int kTogether = 64;
  double product[kTogether];
  for (int first = 0; first < count; first += kTogether) {
    const int some = std::min(kTogether, count - first);
    kernels::SpanDots(rows + static_cast<size_t>(first) * n, n, spans + first,
                      some, y.data(), product);
    for (int k = 0; k < some; ++k) use(first + k, product[k]);
  }
}

Cost FindCost(const Hierarchy& hierarchy, int level,
              const std::vector<double>& y) {
  Cost sum = {0, 0};
  const int n = hierarchy.num_variables();
  const auto b = hierarchy.b(level), weight = hierarchy.weight(level);
  ForEachProduct(hierarchy.B(level).data(), n, hierarchy.B_span(level),
                 hierarchy.num_equalities(level), y, [&](int i, double value) {
                   const double residual = value + b[i];
                   sum.cost += weight[i] * residual * residual;
                   sum.size += weight[i] * (value * value + b[i] * b[i]);
                 });
  const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
  ForEachProduct(hierarchy.C(level).data(), n, hierarchy.C_span(level),
                 hierarchy.num_inequalities(level), y,
                 [&](int i, double value) {
                   const double slack =
                       std::max({value - upper[i], lower[i] - value, 0.0});
                   sum.cost += slack * slack;
                   if (slack > 0) sum.size += value * value;
                 });
  return sum;
}

// Returns twice the cost of a level that rounding of a point can cause, whose largest entry
// is `largest`. Where the terms of all rows cancel, this is more than rounding of the cost.
double CostOfRounding(const Hierarchy& hierarchy, int level, double largest) {
  const double rounding = tolerances::kSolutionRounding * largest;
  const auto square = [&](const auto& rows, const Span* spans, int i) {
    const Span span = spans[i];
    const double residual =
        rounding *
        kernels::AbsoluteSum(rows.row(i).data() + span.first, span.size);
    return residual * residual;
  };
  const auto B = hierarchy.B(level), C = hierarchy.C(level);
  double sum = 0;
  for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
    sum += hierarchy.weight(level)[i] * square(B, hierarchy.B_span(level), i);
  }
  for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
    sum += square(C, hierarchy.C_span(level), i);
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
