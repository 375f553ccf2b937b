// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/cost_order.h"

#include <algorithm>
#include <cmath>

#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/tolerances.h"

namespace poise {
namespace {

struct Cost {
  double cost;  // Twice the cost of a level.
  double size;  // Half of its change by a relative change of 1 of each term.
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
                   sum.size += weight[i] * std::abs(residual) *
                               (std::abs(value) + std::abs(b[i]));
                 });
  const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
  ForEachProduct(
      hierarchy.C(level).data(), n, hierarchy.C_span(level),
      hierarchy.num_inequalities(level), y, [&](int i, double value) {
        const double above = value - upper[i];
        const double slack = std::max({above, lower[i] - value, 0.0});
        if (slack == 0) return;
        const double bound = slack == above ? upper[i] : lower[i];
        sum.cost += slack * slack;
        sum.size += slack * (std::abs(value) + std::abs(bound));
      });
  return sum;
}

// Returns by how much rounding of y, whose largest entry is `largest`, can
// change twice the cost of a level. Where the terms of rows cancel, this is
// more than rounding of the cost.
double CostOfRounding(const Hierarchy& hierarchy, int level,
                      const std::vector<double>& y, double largest) {
  const double rounding = tolerances::kSolutionRounding * largest;
  const int n = hierarchy.num_variables();
  const auto change = [&](const auto& rows, const Span* spans, int i,
                          double residual) {
    const Span span = spans[i];
    const double of_row =
        rounding *
        kernels::AbsoluteSum(rows.row(i).data() + span.first, span.size);
    return (2 * residual + of_row) * of_row;
  };
  const auto B = hierarchy.B(level), C = hierarchy.C(level);
  const Span *B_spans = hierarchy.B_span(level),
             *C_spans = hierarchy.C_span(level);
  double sum = 0;
  const auto b = hierarchy.b(level), weight = hierarchy.weight(level);
  ForEachProduct(B.data(), n, B_spans, hierarchy.num_equalities(level), y,
                 [&](int i, double value) {
                   sum += weight[i] *
                          change(B, B_spans, i, std::abs(value + b[i]));
                 });
  const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
  ForEachProduct(C.data(), n, C_spans, hierarchy.num_inequalities(level), y,
                 [&](int i, double value) {
                   sum += change(
                       C, C_spans, i,
                       std::max({value - upper[i], lower[i] - value, 0.0}));
                 });
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
        difference > CostOfRounding(hierarchy, level,
                                    cost.cost > than.cost ? y : other,
                                    largest)) {
      return cost.cost < than.cost;
    }
  }
  return false;
}

}  // namespace poise
