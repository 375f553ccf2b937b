// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/hqp/hierarchy.h"

namespace poise {

/// Sums over the entries of a row and y, of the columns of the row's span.
struct RowSums {
  double product;           ///< row . y.
  double product_size;      ///< sum_j |row_j y_j|.
  double squared_row_norm;  ///< |row|^2.
};

/// Largest rounding of RowSums and one more addition, relative to the
/// magnitudes of the terms, for a span of n columns: one for the product, n /
/// 4 - 1 for the sum of one of four lanes, two for the sum of the lanes, three
/// for the columns after the last whole four, one for the addition, and two for
/// higher orders.
double RowSumRounding(int n);

/// Returns the sums of a row. The row and y start at column 0.
RowSums SumRow(const double* row, Span span, const double* y);

/// Writes the sums of `count` rows, which are `stride` entries apart.
void SumRows(const double* rows, int stride, const Span* spans, int count,
             const double* y, RowSums* sums);

/// Adds factor_i times row i to `sum`, and |size_i| times the absolute entries
/// of the row to `sum_of_sizes`, for all rows i with size_i != 0. Returns their
/// number.
int AddRowsWithSizes(const double* rows, int stride, const Span* spans,
                     int count, const double* factor, const double* size,
                     double* sum, double* sum_of_sizes);

/// Returns whether all entries outside of the spans are zero, of either sign.
bool AreZeroOutside(const double* rows, int stride, const Span* spans,
                    int count);

}  // namespace poise
