// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/exact/rational.h"

#include <utility>

namespace poise {

Rational Dot(const RationalVector& a, const RationalVector& b) {
  Rational sum = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i] != 0 && b[i] != 0) sum += a[i] * b[i];
  }
  return sum;
}

void AddTo(const Rational& factor, const RationalVector& a,
           RationalVector* sum) {
  if (factor == 0) return;
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i] != 0) (*sum)[i] += factor * a[i];
  }
}

bool IsZero(const RationalVector& a) {
  for (const Rational& entry : a) {
    if (entry != 0) return false;
  }
  return true;
}

std::optional<RationalVector> SolveLinear(RationalMatrix A, RationalVector b,
                                          int num_variables) {
  const size_t rows = A.size();
  std::vector<int> pivots;  // The variable of each leading row.
  for (int j = 0; j < num_variables && pivots.size() < rows; ++j) {
    const size_t top = pivots.size();
    size_t found = top;
    while (found < rows && A[found][j] == 0) ++found;
    if (found == rows) continue;
    std::swap(A[top], A[found]);
    std::swap(b[top], b[found]);
    pivots.push_back(j);
    for (size_t i = 0; i < rows; ++i) {
      if (i == top || A[i][j] == 0) continue;
      const Rational factor = -A[i][j] / A[top][j];
      AddTo(factor, A[top], &A[i]);
      b[i] += factor * b[top];
    }
  }
  for (size_t i = pivots.size(); i < rows; ++i) {
    if (b[i] != 0) return std::nullopt;
  }
  RationalVector x(num_variables);
  for (size_t i = 0; i < pivots.size(); ++i) {
    x[pivots[i]] = b[i] / A[i][pivots[i]];
  }
  return x;
}

}  // namespace poise
