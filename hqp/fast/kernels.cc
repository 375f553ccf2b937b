// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/kernels.h"

#include <algorithm>
#include <cmath>

#include "poise/hqp/four_doubles.h"
#include "poise/math/target_clones.h"

POISE_NO_OTHER_VECTORS

namespace poise::kernels {
namespace {

// Rows `stride` apart.
template <class Number>
struct Apart {
  Number* rows;
  int stride;
  POISE_INLINE Number* operator()(int i) const {
    return rows + static_cast<long>(i) * stride;
  }
};

// Some of them, by their indices.
template <class Number>
struct Chosen {
  Apart<Number> rows;
  const int* index;
  POISE_INLINE Number* operator()(int i) const { return rows(index[i]); }
};

template <class Row>
POISE_INLINE void DotsOf(Row row, int count, const double* x, int n,
                         double* out) {
  const int fours = count & ~3, whole = n & ~3, eights = n & ~7;
  int i = 0;
  for (; i < fours; i += 4) {
    const double *r0 = row(i), *r1 = row(i + 1);
    const double *r2 = row(i + 2), *r3 = row(i + 3);
    Four s0 = {}, s1 = {}, s2 = {}, s3 = {};
    for (int j = 0; j < whole; j += 4) {
      const Four xj = POISE_LOAD(x + j);
      s0 += POISE_LOAD(r0 + j) * xj;
      s1 += POISE_LOAD(r1 + j) * xj;
      s2 += POISE_LOAD(r2 + j) * xj;
      s3 += POISE_LOAD(r3 + j) * xj;
    }
    double d0 = POISE_SUM(s0), d1 = POISE_SUM(s1);
    double d2 = POISE_SUM(s2), d3 = POISE_SUM(s3);
    for (int j = whole; j < n; ++j) {
      d0 += r0[j] * x[j];
      d1 += r1[j] * x[j];
      d2 += r2[j] * x[j];
      d3 += r3[j] * x[j];
    }
    out[i] = d0;
    out[i + 1] = d1;
    out[i + 2] = d2;
    out[i + 3] = d3;
  }
  for (; i < count; ++i) {
    const double* r = row(i);
    Four s0 = {}, s1 = {};
    int j = 0;
    for (; j < eights; j += 8) {
      s0 += POISE_LOAD(r + j) * POISE_LOAD(x + j);
      s1 += POISE_LOAD(r + j + 4) * POISE_LOAD(x + j + 4);
    }
    s0 += s1;
    double d = POISE_SUM(s0);
    for (; j < n; ++j) d += r[j] * x[j];
    out[i] = d;
  }
}

template <class Row>
POISE_INLINE void AddRowsOf(Row row, int count, const double* factor, int n,
                            double* x) {
  const int fours = count & ~3, whole = n & ~3;
  int i = 0;
  for (; i < fours; i += 4) {
    const double *r0 = row(i), *r1 = row(i + 1);
    const double *r2 = row(i + 2), *r3 = row(i + 3);
    const double f0 = factor[i], f1 = factor[i + 1];
    const double f2 = factor[i + 2], f3 = factor[i + 3];
    for (int j = 0; j < whole; j += 4) {
      const Four low = POISE_LOAD(r0 + j) * f0 + POISE_LOAD(r1 + j) * f1;
      const Four high = POISE_LOAD(r2 + j) * f2 + POISE_LOAD(r3 + j) * f3;
      POISE_STORE(x + j) += low + high;
    }
    for (int j = whole; j < n; ++j) {
      x[j] += (r0[j] * f0 + r1[j] * f1) + (r2[j] * f2 + r3[j] * f3);
    }
  }
  for (; i < count; ++i) {
    const double* r = row(i);
    const double f = factor[i];
    for (int j = 0; j < whole; j += 4) {
      POISE_STORE(x + j) += POISE_LOAD(r + j) * f;
    }
    for (int j = whole; j < n; ++j) x[j] += r[j] * f;
  }
}

template <class Row>
POISE_INLINE void AddToRowsOf(Row row, int count, const double* factor,
                              const double* x, int n) {
  const int pairs = count & ~1, whole = n & ~3;
  int i = 0;
  for (; i < pairs; i += 2) {
    double *r0 = row(i), *r1 = row(i + 1);
    const double f0 = factor[i], f1 = factor[i + 1];
    for (int j = 0; j < whole; j += 4) {
      const Four xj = POISE_LOAD(x + j);
      POISE_STORE(r0 + j) += xj * f0;
      POISE_STORE(r1 + j) += xj * f1;
    }
    for (int j = whole; j < n; ++j) {
      r0[j] += x[j] * f0;
      r1[j] += x[j] * f1;
    }
  }
  for (; i < count; ++i) {
    double* r = row(i);
    const double f = factor[i];
    for (int j = 0; j < whole; j += 4) {
      POISE_STORE(r + j) += POISE_LOAD(x + j) * f;
    }
    for (int j = whole; j < n; ++j) r[j] += x[j] * f;
  }
}

POISE_INLINE double SumOfSizes(const double* x, int n) {
  const int whole = n & ~3;
  double size = 0;
  if (whole > 0) {  // Most rows have fewer entries.
    Four sum = {};
    for (int j = 0; j < whole; j += 4) {
      const Four xj = POISE_LOAD(x + j);
      sum += xj < 0 ? -xj : xj;
    }
    size = POISE_SUM(sum);
  }
  for (int j = whole; j < n; ++j) size += std::abs(x[j]);
  return size;
}

}  // namespace

POISE_TARGET_CLONES("fma")
void Dots(const double* rows, int stride, int count, const double* x, int n,
          double* out) {
  DotsOf(Apart<const double>{rows, stride}, count, x, n, out);
}

POISE_TARGET_CLONES("fma")
void Dots(const double* rows, int stride, const int* index, int count,
          const double* x, int n, double* out) {
  DotsOf(Chosen<const double>{{rows, stride}, index}, count, x, n, out);
}

POISE_TARGET_CLONES("fma")
void SpanDots(const double* rows, int stride, const Span* spans, int count,
              const double* x, double* out) {
  for (int i = 0; i < count;) {
    const auto [first, size] = spans[i];
    const double* row = rows + static_cast<long>(i) * stride + first;
    const double* at = x + first;
    if (size < 4) {  // Most rows have so few entries.
      double dot = 0;
      for (int j = 0; j < size; ++j) dot += row[j] * at[j];
      out[i++] = dot;
      continue;
    }
    int same = i + 1;
    while (same < count && spans[same].first == first &&
           spans[same].size == size) {
      ++same;
    }
    DotsOf(Apart<const double>{row, stride}, same - i, at, size, out + i);
    i = same;
  }
}

POISE_TARGET_CLONES("fma")
void AddRows(const double* rows, int stride, int count, const double* factor,
             int n, double* x) {
  AddRowsOf(Apart<const double>{rows, stride}, count, factor, n, x);
}

POISE_TARGET_CLONES("fma")
void AddRows(const double* rows, int stride, const int* index, int count,
             const double* factor, int n, double* x) {
  AddRowsOf(Chosen<const double>{{rows, stride}, index}, count, factor, n, x);
}

POISE_TARGET_CLONES("fma")
void AddToRows(double* rows, int stride, int count, const double* factor,
               const double* x, int n) {
  AddToRowsOf(Apart<double>{rows, stride}, count, factor, x, n);
}

POISE_TARGET_CLONES("fma")
void AddToRows(double* rows, int stride, const int* index, int count,
               const double* factor, const double* x, int n) {
  AddToRowsOf(Chosen<double>{{rows, stride}, index}, count, factor, x, n);
}

POISE_TARGET_CLONES("fma")
void Divide(const double* x, double divisor, int n, double* out) {
  int j = 0;
  for (; j + 4 <= n; j += 4) POISE_STORE(out + j) = POISE_LOAD(x + j) / divisor;
  for (; j < n; ++j) out[j] = x[j] / divisor;
}

POISE_TARGET_CLONES("fma")
void Scale(const double* x, double factor, int n, double* out) {
  int j = 0;
  for (; j + 4 <= n; j += 4) POISE_STORE(out + j) = POISE_LOAD(x + j) * factor;
  for (; j < n; ++j) out[j] = x[j] * factor;
}

POISE_TARGET_CLONES("fma")
void MultiplyEntries(const double* x, const double* factor, double least, int n,
                     double* out) {
  const Four none = {};
  int j = 0;
  for (; j + 4 <= n; j += 4) {
    const Four xj = POISE_LOAD(x + j), size = xj < 0 ? -xj : xj;
    POISE_STORE(out + j) = size < least ? none : xj * POISE_LOAD(factor + j);
  }
  for (; j < n; ++j) out[j] = std::abs(x[j]) < least ? 0 : factor[j] * x[j];
}

POISE_TARGET_CLONES("fma")
void ColumnSquares(const double* rows, int stride, int count, int n,
                   double* sums) {
  const int fours = count & ~3, whole = n & ~3;
  std::fill_n(sums, n, 0);
  for (int i = 0; i < fours; i += 4) {
    const double* r0 = rows + static_cast<long>(i) * stride;
    const double *r1 = r0 + stride, *r2 = r1 + stride, *r3 = r2 + stride;
    for (int j = 0; j < whole; j += 4) {
      const Four x0 = POISE_LOAD(r0 + j), x1 = POISE_LOAD(r1 + j);
      const Four x2 = POISE_LOAD(r2 + j), x3 = POISE_LOAD(r3 + j);
      POISE_STORE(sums + j) += (x0 * x0 + x1 * x1) + (x2 * x2 + x3 * x3);
    }
    for (int j = whole; j < n; ++j) {
      sums[j] +=
          (r0[j] * r0[j] + r1[j] * r1[j]) + (r2[j] * r2[j] + r3[j] * r3[j]);
    }
  }
  for (int i = fours; i < count; ++i) {
    const double* r = rows + static_cast<long>(i) * stride;
    for (int j = 0; j < whole; j += 4) {
      const Four x = POISE_LOAD(r + j);
      POISE_STORE(sums + j) += x * x;
    }
    for (int j = whole; j < n; ++j) sums[j] += r[j] * r[j];
  }
}

POISE_TARGET_CLONES("fma")
void Rotate(double c, double s, int n, double* x, double* y) {
  int j = 0;
  for (; j + 4 <= n; j += 4) {
    const Four xj = POISE_LOAD(x + j), yj = POISE_LOAD(y + j);
    POISE_STORE(x + j) = xj * c + yj * s;
    POISE_STORE(y + j) = yj * c - xj * s;
  }
  for (; j < n; ++j) {
    const double xj = x[j], yj = y[j];
    x[j] = xj * c + yj * s;
    y[j] = yj * c - xj * s;
  }
}

POISE_TARGET_CLONES("fma")
void DotWithSize(const double* row, const double* x, int n, double* dot,
                 double* size) {
  const int whole = n & ~3;
  Four sum = {}, absolute = {};
  int j = 0;
  for (; j < whole; j += 4) {
    const Four term = POISE_LOAD(row + j) * POISE_LOAD(x + j);
    sum += term;
    absolute += term < 0 ? -term : term;
  }
  *dot = POISE_SUM(sum);
  *size = POISE_SUM(absolute);
  for (; j < n; ++j) {
    *dot += row[j] * x[j];
    *size += std::abs(row[j] * x[j]);
  }
}

POISE_TARGET_CLONES("fma")
double AbsoluteSum(const double* x, int n) { return SumOfSizes(x, n); }

POISE_TARGET_CLONES("fma")
void SpanAbsoluteSums(const double* rows, int stride, const Span* spans,
                      int count, double* out) {
  for (int i = 0; i < count; ++i) {
    const auto [first, size] = spans[i];
    out[i] = SumOfSizes(rows + static_cast<long>(i) * stride + first, size);
  }
}

POISE_TARGET_CLONES("fma")
double Largest(const double* x, int n) {
  const int whole = n & ~3;
  Four most = {};
  int j = 0;
  for (; j < whole; j += 4) {
    const Four xj = POISE_LOAD(x + j);
    const Four size = xj < 0 ? -xj : xj;
    most = most < size ? size : most;
  }
  double largest =
      std::max(std::max(most[0], most[2]), std::max(most[1], most[3]));
  for (; j < n; ++j) largest = std::max(largest, std::abs(x[j]));
  return largest;
}

}  // namespace poise::kernels
