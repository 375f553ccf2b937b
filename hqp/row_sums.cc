// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/row_sums.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "poise/hqp/four_doubles.h"
#include "poise/math/target_clones.h"

POISE_NO_OTHER_VECTORS

namespace poise {
namespace {

POISE_INLINE RowSums Sum(const double* row, Span span, const double* y) {
  const double* r = row + span.first;
  const double* at = y + span.first;
  const int whole = span.size - span.size % 4;
  RowSums sums = {};
  if (whole > 0) {  // Most rows have fewer entries.
    Four product = {}, size = {}, squares = {};
    for (int j = 0; j < whole; j += 4) {
      const Four rj = POISE_LOAD(r + j);
      const Four term = rj * POISE_LOAD(at + j);
      product += term;
      size += term < 0 ? -term : term;
      squares += rj * rj;
    }
    sums = {POISE_SUM(product), POISE_SUM(size), POISE_SUM(squares)};
  }
  for (int j = whole; j < span.size; ++j) {
    const double term = r[j] * at[j];
    sums.product += term;
    sums.product_size += std::abs(term);
    sums.squared_row_norm += r[j] * r[j];
  }
  return sums;
}

POISE_INLINE void AddWithSize(const double* row, Span span, double factor,
                              double size, double* sum, double* sum_of_sizes) {
  const double* r = row + span.first;
  double *to = sum + span.first, *to_size = sum_of_sizes + span.first;
  const int whole = span.size - span.size % 4;
  for (int j = 0; j < whole; j += 4) {
    const Four rj = POISE_LOAD(r + j);
    POISE_STORE(to + j) += rj * factor;
    POISE_STORE(to_size + j) += (rj < 0 ? -rj : rj) * size;
  }
  for (int j = whole; j < span.size; ++j) {
    to[j] += factor * r[j];
    to_size[j] += size * std::abs(r[j]);
  }
}

typedef std::uint64_t FourWords
    __attribute__((vector_size(32), aligned(8), may_alias));
typedef std::uint64_t Word __attribute__((may_alias));

// Adds the bits of n entries to `bits`.
POISE_INLINE void AddBits(const double* x, int n, FourWords* bits) {
  if (n < 4) {
    for (int j = 0; j < n; ++j)
      (*bits)[0] |= reinterpret_cast<const Word*>(x)[j];
    return;
  }
  for (int j = 0; j < n - 4; j += 4) {
    *bits |= *reinterpret_cast<const FourWords*>(x + j);
  }
  // The last four may overlap with those before.
  *bits |= *reinterpret_cast<const FourWords*>(x + n - 4);
}

}  // namespace

double RowSumRounding(int n) {
  return (n / 4 + 8) * std::numeric_limits<double>::epsilon() / 2;
}

POISE_TARGET_CLONES("avx2")
RowSums SumRow(const double* row, Span span, const double* y) {
  return Sum(row, span, y);
}

POISE_TARGET_CLONES("avx2")
void SumRows(const double* rows, int stride, const Span* spans, int count,
             const double* y, RowSums* sums) {
  for (int i = 0; i < count; ++i) {
    sums[i] = Sum(rows + static_cast<long>(i) * stride, spans[i], y);
  }
}

POISE_TARGET_CLONES("avx2")
int AddRowsWithSizes(const double* rows, int stride, const Span* spans,
                     int count, const double* factor, const double* size,
                     double* sum, double* sum_of_sizes) {
  int added = 0;
  for (int i = 0; i < count; ++i) {
    if (size[i] == 0) continue;
    ++added;
    AddWithSize(rows + static_cast<long>(i) * stride, spans[i], factor[i],
                std::abs(size[i]), sum, sum_of_sizes);
  }
  return added;
}

POISE_TARGET_CLONES("avx2")
bool AreZeroOutside(const double* rows, int stride, const Span* spans,
                    int count) {
  // The entries after a row's span and before that of the next row are
  // neighbours.
  FourWords bits = {};
  const double* begin = rows;
  for (int i = 0; i < count; ++i) {
    const auto [first, size] = spans[i];
    if (first < 0 || size < 0 || first + size > stride) return false;
    const double* span = rows + static_cast<long>(i) * stride + first;
    AddBits(begin, static_cast<int>(span - begin), &bits);
    begin = span + size;
  }
  const double* end = rows + static_cast<long>(count) * stride;
  AddBits(begin, static_cast<int>(end - begin), &bits);
  // The first bit is the sign.
  return ((bits[0] | bits[1]) | (bits[2] | bits[3])) << 1 == 0;
}

}  // namespace poise
