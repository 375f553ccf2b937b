// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/row_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace poise {
namespace {

constexpr int kStride = 21;

// Rows with each span of kStride columns. Outside of its span, a row is zero.
struct Rows {
  std::vector<double> entries;
  std::vector<Span> spans;

  int count() const { return static_cast<int>(spans.size()); }
  const double* row(int i) const { return entries.data() + i * kStride; }
};

// Returns multiples of 1/8 with few digits, so that every sum is exact in any
// order.
double Eighth(std::mt19937* random) {
  return std::uniform_int_distribution<int>(-40, 40)(*random) / 8.0;
}

std::vector<double> Eighths(int count, std::mt19937* random) {
  std::vector<double> numbers(count);
  for (double& number : numbers) number = Eighth(random);
  return numbers;
}

Rows AllSpans(std::mt19937* random) {
  Rows rows;
  for (int first = 0; first <= kStride; ++first) {
    for (int size = 0; first + size <= kStride; ++size) {
      rows.spans.push_back({first, size});
      for (int j = 0; j < kStride; ++j) {
        const bool is_in_span = j >= first && j < first + size;
        rows.entries.push_back(is_in_span ? Eighth(random) : 0);
      }
    }
  }
  return rows;
}

TEST(RowSums, AreThoseOfWholeRows) {
  std::mt19937 random(1);
  const Rows rows = AllSpans(&random);
  const std::vector<double> y = Eighths(kStride, &random);
  std::vector<RowSums> sums(rows.count());
  SumRows(rows.entries.data(), kStride, rows.spans.data(), rows.count(),
          y.data(), sums.data());
  for (int i = 0; i < rows.count(); ++i) {
    double product = 0, size = 0, squares = 0;
    for (int j = 0; j < kStride; ++j) {
      const double entry = rows.row(i)[j];
      product += entry * y[j];
      size += std::abs(entry * y[j]);
      squares += entry * entry;
    }
    const RowSums one = SumRow(rows.row(i), rows.spans[i], y.data());
    for (const RowSums& sum : {sums[i], one}) {
      EXPECT_EQ(sum.product, product);
      EXPECT_EQ(sum.product_size, size);
      EXPECT_EQ(sum.squared_row_norm, squares);
    }
  }
}

struct LongSums {
  long double product = 0, size = 0;
};

LongSums SumPrecisely(const std::vector<double>& row,
                      const std::vector<double>& y) {
  LongSums sums;
  for (size_t j = 0; j < row.size(); ++j) {
    const long double term = static_cast<long double>(row[j]) * y[j];
    sums.product += term;
    sums.size += std::abs(term);
  }
  return sums;
}

// Random numbers with all their digits, compared with sums in long double.
TEST(RowSums, RoundAsMuchAsStatedAtMost) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 200; ++n) {
    std::vector<double> row(n), y(n);
    for (int j = 0; j < n; ++j) {
      row[j] = normal(random);
      y[j] = normal(random);
    }
    const LongSums exact = SumPrecisely(row, y);
    const long double rounding = RowSumRounding(n) * exact.size;
    const RowSums sums = SumRow(row.data(), {0, n}, y.data());
    EXPECT_LE(std::abs(sums.product - exact.product), rounding) << n;
    EXPECT_LE(std::abs(sums.product_size - exact.size), rounding) << n;
  }
}

// Terms that nearly all sums round down. Each of the four lanes begins with a
// term near `sign`, which is 1 for lanes 0 and 2. All other terms are positive
// and just below half of the last digit of the sum to which they are added, so
// that the sum loses them.
struct LosingTerms {
  LosingTerms(int n, double sign) : row(n, 0.499 * kEps), y(n, 1) {
    // This product is 1 + 2^-26 + 2^-27 - 2^-40 and nearly half of a digit
    // more.
    const double r = 1 + 0x1p-26 - 0x1p-40, at = 1 + 0x1p-27;
    // The sum of lanes 0 and 2 ends in half of a digit, and so does that of all
    // four.
    const int digits[] = {0, 0, 1, 2};
    for (int lane = 0; lane < 4; ++lane) {
      row[lane] = r + digits[lane] * kEps;
      y[lane] = lane % 2 == 0 ? at : sign * at;
    }
    // The sum of the lanes is 4.
    for (int j = n - n % 4; j < n; ++j) row[j] *= 4;
  }

  static constexpr double kEps = std::numeric_limits<double>::epsilon();
  std::vector<double> row, y;
};

// With 7 columns and one more addition, RowSumRounding() counts 9 roundings of
// all terms. These terms have 6.5: products 1, sums of lanes 1.5, later columns
// 3, addition 1. With more columns, the part is larger.
TEST(RowSums, RoundNearlyAsMuchAsStated) {
  for (const int n : {7, 43, 403}) {
    SCOPED_TRACE(n);
    const LosingTerms terms(n, 1);
    const LongSums exact = SumPrecisely(terms.row, terms.y);
    const RowSums sums = SumRow(terms.row.data(), {0, n}, terms.y.data());
    const double added = 0.499 * 4 * LosingTerms::kEps;
    const long double size = exact.size + added;
    const long double error = exact.product + added - (sums.product + added);
    EXPECT_LE(error, RowSumRounding(n) * size);
    EXPECT_GE(error, 0.7 * RowSumRounding(n) * size);
    EXPECT_EQ(sums.product_size, sums.product);
  }
}

// Lanes 0 and 2 cancel lanes 1 and 3, so that the product is wrong by its whole
// value. The rounding is that of the lanes, 99 of the stated 108.
TEST(RowSums, RoundNearlyAsMuchAsStatedIfTheyCancel) {
  const int n = 400;
  const LosingTerms terms(n, -1);
  const LongSums exact = SumPrecisely(terms.row, terms.y);
  const RowSums sums = SumRow(terms.row.data(), {0, n}, terms.y.data());
  const long double error = exact.product - sums.product;
  // The two digits of `digits` that do not cancel.
  EXPECT_LE(std::abs(sums.product), 2 * LosingTerms::kEps);
  EXPECT_LE(error, RowSumRounding(n) * exact.size);
  EXPECT_GE(error, 0.9 * RowSumRounding(n) * exact.size);
}

TEST(RowSums, AddRowsWithASize) {
  std::mt19937 random(3);
  const Rows rows = AllSpans(&random);
  const std::vector<double> factor = Eighths(rows.count(), &random);
  std::vector<double> size = Eighths(rows.count(), &random);
  std::vector<double> sum(kStride, 1), sum_of_sizes(kStride, 2);
  int with_size = 0;
  std::vector<double> expected = sum, expected_sizes = sum_of_sizes;
  for (int i = 0; i < rows.count(); ++i) {
    if (i % 3 == 0) size[i] = 0;  // The factor must not count then.
    if (size[i] == 0) continue;
    ++with_size;
    for (int j = 0; j < kStride; ++j) {
      expected[j] += factor[i] * rows.row(i)[j];
      expected_sizes[j] += std::abs(size[i] * rows.row(i)[j]);
    }
  }
  EXPECT_EQ(AddRowsWithSizes(rows.entries.data(), kStride, rows.spans.data(),
                             rows.count(), factor.data(), size.data(),
                             sum.data(), sum_of_sizes.data()),
            with_size);
  EXPECT_EQ(sum, expected);
  EXPECT_EQ(sum_of_sizes, expected_sizes);
}

TEST(RowSums, FindEveryEntryOutsideASpan) {
  std::mt19937 random(4);
  Rows rows = AllSpans(&random);
  const auto are_zero = [&rows](int i) {
    return AreZeroOutside(rows.row(i), kStride, &rows.spans[i], 1);
  };
  const auto are_all_zero = [&rows] {
    return AreZeroOutside(rows.entries.data(), kStride, rows.spans.data(),
                          rows.count());
  };
  EXPECT_TRUE(are_all_zero());
  for (int i = 0; i < rows.count(); ++i) {
    for (int j = 0; j < kStride; ++j) {
      const Span span = rows.spans[i];
      if (j >= span.first && j < span.first + span.size) continue;
      double& entry = rows.entries[i * kStride + j];
      for (const double value :
           {1.0, -1.0, std::numeric_limits<double>::denorm_min(),
            std::numeric_limits<double>::quiet_NaN()}) {
        entry = value;
        EXPECT_FALSE(are_zero(i)) << i << " " << j << " " << value;
        EXPECT_FALSE(are_all_zero()) << i << " " << j << " " << value;
      }
      entry = -0.0;
      EXPECT_TRUE(are_zero(i));
      entry = 0;
    }
  }
}

// A span that goes beyond its row would hide entries of the next one.
TEST(RowSums, RefuseSpansBeyondTheRow) {
  const std::vector<double> rows(3 * kStride, 0);
  for (const Span span :
       {Span{-1, 2}, Span{1, kStride}, Span{kStride, 1}, Span{2, -1}}) {
    const Span spans[3] = {{0, kStride}, span, {0, kStride}};
    EXPECT_FALSE(AreZeroOutside(rows.data(), kStride, spans, 3))
        << span.first << " " << span.size;
  }
  for (const Span span : {Span{0, kStride}, Span{kStride, 0}, Span{0, 0}}) {
    EXPECT_TRUE(AreZeroOutside(rows.data(), kStride, &span, 1));
  }
}

}  // namespace
}  // namespace poise
