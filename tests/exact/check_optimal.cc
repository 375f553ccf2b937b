// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/exact/check_optimal.h"

#include <stdexcept>
#include <string>

#include "poise/tests/exact/rational_rows.h"

namespace poise {
namespace {

void Require(bool holds, size_t level, const std::string& condition) {
  if (holds) return;
  throw std::logic_error("level " + std::to_string(level) + ": " + condition);
}

bool IsAllowed(const RationalRows& rows, int i, const RationalVector& y,
               const Rational& multiplier) {
  if (Violation(rows, i, y) != 0) return true;
  const Rational value = Dot(rows.C[i], y);
  const bool at_upper = rows.upper[i] && value == *rows.upper[i];
  const bool at_lower = rows.lower[i] && value == *rows.lower[i];
  return (at_upper || multiplier <= 0) && (at_lower || multiplier >= 0);
}

RationalVector CostGradient(const RationalRows& rows, const RationalVector& y) {
  RationalVector gradient(y.size());
  for (size_t i = 0; i < rows.B.size(); ++i) {
    AddTo(rows.weight[i] * (Dot(rows.B[i], y) + rows.b[i]), rows.B[i],
          &gradient);
  }
  for (size_t i = 0; i < rows.C.size(); ++i) {
    AddTo(Violation(rows, static_cast<int>(i), y), rows.C[i], &gradient);
  }
  return gradient;
}

}  // namespace

void CheckOptimal(const Hierarchy& hierarchy, const ExactOptimum& optimum) {
  const std::vector<RationalRows> levels = MakeRationalRows(hierarchy);
  const RationalVector& y = optimum.y;
  for (size_t k = 0; k < levels.size(); ++k) {
    const ExactLevel& answer = optimum.levels.at(k);
    Require(answer.cost == CostAt(levels[k], y), k,
            "the cost is not that of y");
    RationalVector gradient = CostGradient(levels[k], y);
    for (size_t j = 0; j < k; ++j) {
      const ExactMultipliers& of = answer.multipliers.at(j);
      for (size_t i = 0; i < levels[j].B.size(); ++i) {
        Require(levels[j].weight[i] != 0 || of.equality.at(i) == 0, k,
                "an equality of weight 0 has a multiplier");
        AddTo(of.equality.at(i), levels[j].B[i], &gradient);
      }
      for (size_t i = 0; i < levels[j].C.size(); ++i) {
        Require(
            IsAllowed(levels[j], static_cast<int>(i), y, of.inequality.at(i)),
            k, "a multiplier of an inequality has the wrong sign");
        AddTo(of.inequality.at(i), levels[j].C[i], &gradient);
      }
    }
    Require(IsZero(gradient), k, "the gradient is not zero");
  }
}

}  // namespace poise
