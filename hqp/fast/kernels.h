// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cmath>

#include "poise/hqp/hierarchy.h"

/// The inner loops of the fast solver, on rows that lie `stride` apart: on the
/// first `count` of them, or on those with `count` given indices. Most loops
/// process four rows at a time, in vectors of four. The loader selects the
/// version for the processor.
namespace poise::kernels {

/// A row takes about as much time as this many more multiply-adds.
constexpr int kRowOverhead = 40;

/// out_i = row_i . x, for i < count.
void Dots(const double* rows, int stride, int count, const double* x, int n,
          double* out);

/// out_i = row_index(i) . x, for i < count.
void Dots(const double* rows, int stride, const int* index, int count,
          const double* x, int n, double* out);

/// out_i = row_i . x, for i < count, where row_i is zero outside its span.
void SpanDots(const double* rows, int stride, const Span* spans, int count,
              const double* x, double* out);

/// |x|_2^2.
inline double SquaredNorm(const double* x, int n) {
  double sum;
  Dots(x, 0, 1, x, n, &sum);
  return sum;
}

/// *dot = row . x, and *size = sum_j |row_j x_j|.
void DotWithSize(const double* row, const double* x, int n, double* dot,
                 double* size);

/// x += sum_i factor_i row_i.
void AddRows(const double* rows, int stride, int count, const double* factor,
             int n, double* x);

/// x += sum_i factor_i row_index(i).
void AddRows(const double* rows, int stride, const int* index, int count,
             const double* factor, int n, double* x);

/// row_i += factor_i x.
void AddToRows(double* rows, int stride, int count, const double* factor,
               const double* x, int n);

/// row_index(i) += factor_i x. No index occurs twice.
void AddToRows(double* rows, int stride, const int* index, int count,
               const double* factor, const double* x, int n);

/// out_j = x_j / divisor. `out` may be `x`. More exact than Scale(), and eight
/// times slower.
void Divide(const double* x, double divisor, int n, double* out);

/// out = factor x. `out` may be `x`.
void Scale(const double* x, double factor, int n, double* out);

/// out_j = factor_j x_j, or 0 where |x_j| < least.
void MultiplyEntries(const double* x, const double* factor, double least, int n,
                     double* out);

/// sums_j = sum_i row_ij^2, for i < count.
void ColumnSquares(const double* rows, int stride, int count, int n,
                   double* sums);

/// (x, y) = (c x + s y, c y - s x).
void Rotate(double c, double s, int n, double* x, double* y);

/// sum_i |x_i|: NaN or infinite if an entry is.
double AbsoluteSum(const double* x, int n);

/// out_i = AbsoluteSum() of the span of row i, for i < count.
void SpanAbsoluteSums(const double* rows, int stride, const Span* spans,
                      int count, double* out);

/// max_i |x_i|, or 0 if n = 0.
double Largest(const double* x, int n);

/// (x_0, x_1) = (c x_0 + s x_1, c x_1 - s x_0).
inline void RotatePair(double c, double s, double* x) {
  const double first = x[0], second = x[1];
  x[0] = c * first + s * second;
  x[1] = c * second - s * first;
}

/// Returns the length of (x, y), faster than std::hypot(). A square that
/// underflows, below 1e-308, is less than rounding of a sum above 1e-280. For
/// smaller or infinite sums, this function calls std::hypot().
inline double Length(double x, double y) {
  constexpr double kLeast = 1e-280, kMost = 1e280;
  const double squares = x * x + y * y;
  return squares > kLeast && squares < kMost ? std::sqrt(squares)
                                             : std::hypot(x, y);
}

}  // namespace poise::kernels
