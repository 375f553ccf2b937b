// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace poise {
namespace {

// Returns multiples of 1/8 with few digits, so that every sum is exact in any
// order.
std::vector<double> Eighths(int count, int seed) {
  std::vector<double> numbers(count);
  for (int i = 0; i < count; ++i) {
    numbers[i] = ((i * i + 7 * i * seed) % 23 - 11) / 8.0;
  }
  return numbers;
}

// Tests all sizes up to kMaxRows and kMaxSize, with every remainder after
// blocks of four and eight.
class KernelsTest : public testing::Test {
 protected:
  static constexpr int kMaxRows = 9, kMaxSize = 19, kStride = 21;
  static constexpr double kUntouched = 1e6;

  template <typename Check>
  static void ForAllSizes(Check check) {
    for (int rows = 0; rows <= kMaxRows; ++rows) {
      for (int n = 0; n <= kMaxSize; ++n) {
        SCOPED_TRACE(testing::Message() << rows << " rows of " << n);
        check(rows, n);
      }
    }
  }
  double Entry(int i, int j) const { return rows_[i * kStride + j]; }

  std::vector<double> rows_ = Eighths((kMaxRows + 1) * kStride, 1);
  const std::vector<double> x_ = Eighths(kStride, 2),
                            factor_ = Eighths(kStride, 3);
};

TEST_F(KernelsTest, DotsAreTheSumsOfProducts) {
  ForAllSizes([&](int rows, int n) {
    std::vector<double> out(kMaxRows + 1, kUntouched);
    kernels::Dots(rows_.data(), kStride, rows, x_.data(), n, out.data());
    for (int i = 0; i < rows; ++i) {
      double sum = 0;
      for (int j = 0; j < n; ++j) sum += Entry(i, j) * x_[j];
      EXPECT_EQ(out[i], sum) << i;
    }
    for (int i = rows; i <= kMaxRows; ++i) EXPECT_EQ(out[i], kUntouched) << i;
  });
}

// With indices, a kernel does the same as without on copies of these rows, and
// changes no other row. Every second row is left out, and the order is
// reversed.
TEST_F(KernelsTest, IndicesChooseRows) {
  ForAllSizes([&](int rows, int n) {
    std::vector<int> index;
    std::vector<double> copies;
    for (int i = rows - 1; i >= 0; i -= 2) {
      index.push_back(i);
      copies.insert(copies.end(), &rows_[i * kStride],
                    &rows_[(i + 1) * kStride]);
    }
    const int count = static_cast<int>(index.size());
    std::vector<double> out(kMaxRows + 1, kUntouched), wanted = out;
    kernels::Dots(rows_.data(), kStride, index.data(), count, x_.data(), n,
                  out.data());
    kernels::Dots(copies.data(), kStride, count, x_.data(), n, wanted.data());
    EXPECT_EQ(out, wanted);

    std::vector<double> sum = x_, wanted_sum = x_;
    kernels::AddRows(rows_.data(), kStride, index.data(), count, factor_.data(),
                     n, sum.data());
    kernels::AddRows(copies.data(), kStride, count, factor_.data(), n,
                     wanted_sum.data());
    EXPECT_EQ(sum, wanted_sum);

    std::vector<double> changed = rows_, wanted_changed = rows_;
    kernels::AddToRows(changed.data(), kStride, index.data(), count,
                       factor_.data(), x_.data(), n);
    kernels::AddToRows(copies.data(), kStride, count, factor_.data(), x_.data(),
                       n);
    for (int i = 0; i < count; ++i) {
      std::copy_n(&copies[i * kStride], kStride,
                  &wanted_changed[index[i] * kStride]);
    }
    EXPECT_EQ(changed, wanted_changed);
  });
}

// Entries outside a row's span do not count, whatever they are. Neighbouring
// rows with the same span share a loop.
TEST_F(KernelsTest, SpansLimitTheProductsAndSums) {
  for (const int num_same : {1, 2, 5}) {
    ForAllSizes([&](int rows, int n) {
      std::vector<Span> spans;
      std::vector<double> only_spans = rows_;
      for (int i = 0; i < rows; ++i) {
        // The next group has another first entry, another size, or both.
        const int group = i / num_same;
        const int first = (group + 1) / 3 % (n + 1);
        const int size = (n - first) / (1 + (group / 2) % 3);
        spans.push_back({first, size});
        for (int j = 0; j < n; ++j) {
          if (j < first || j >= first + size) only_spans[i * kStride + j] = 0;
        }
      }
      std::vector<double> out(kMaxRows + 1, kUntouched), dots = out, sums = out;
      kernels::SpanDots(rows_.data(), kStride, spans.data(), rows, x_.data(),
                        out.data());
      kernels::Dots(only_spans.data(), kStride, rows, x_.data(), n,
                    dots.data());
      EXPECT_EQ(out, dots);
      kernels::SpanAbsoluteSums(rows_.data(), kStride, spans.data(), rows,
                                sums.data());
      for (int i = 0; i < rows; ++i) {
        EXPECT_EQ(sums[i], kernels::AbsoluteSum(&only_spans[i * kStride], n));
      }
      EXPECT_EQ(sums[rows], kUntouched);
    });
  }
}

TEST_F(KernelsTest, SquaredNormIsTheSumOfOddNumbers) {
  // For whole numbers, k^2 = 1 + 3 + ... + (2k - 1), whatever the sign.
  for (int n = 0; n <= kMaxSize; ++n) {
    std::vector<double> x(kMaxSize + 1, kUntouched);
    double sum = 0;
    for (int j = 0; j < n; ++j) {
      const int k = (5 * j + n) % 23;
      x[j] = j % 2 == 0 ? k : -k;
      for (int odd = 1; odd < 2 * k; odd += 2) sum += odd;
    }
    EXPECT_EQ(kernels::SquaredNorm(x.data(), n), sum) << n;
  }
}

TEST_F(KernelsTest, RotateMixesTwoVectors) {
  ForAllSizes([&](int, int n) {
    std::vector<double> x = x_, y = factor_;
    kernels::Rotate(3, 5, n, x.data(), y.data());
    for (int j = 0; j < kStride; ++j) {
      EXPECT_EQ(x[j], j < n ? 3 * x_[j] + 5 * factor_[j] : x_[j]) << j;
      EXPECT_EQ(y[j], j < n ? 3 * factor_[j] - 5 * x_[j] : factor_[j]) << j;
    }
  });
}

TEST_F(KernelsTest, RotatePairRotatesTwoNeighbours) {
  double x[] = {7, -2, 3, 11};
  kernels::RotatePair(0.6, 0.8, x + 1);
  double expected[] = {-2, 3};
  kernels::Rotate(0.6, 0.8, 1, &expected[0], &expected[1]);
  EXPECT_EQ(x[0], 7);
  EXPECT_DOUBLE_EQ(x[1], expected[0]);
  EXPECT_DOUBLE_EQ(x[2], expected[1]);
  EXPECT_EQ(x[3], 11);
}

TEST_F(KernelsTest, AddRowsIsTheSumOfScaledRows) {
  ForAllSizes([&](int rows, int n) {
    std::vector<double> sum = x_;
    kernels::AddRows(rows_.data(), kStride, rows, factor_.data(), n,
                     sum.data());
    for (int j = 0; j < kStride; ++j) {
      double expected = x_[j];
      for (int i = 0; i < rows && j < n; ++i) {
        expected += factor_[i] * Entry(i, j);
      }
      EXPECT_EQ(sum[j], expected) << j;
    }
  });
}

TEST_F(KernelsTest, AddToRowsIsTheOuterProduct) {
  ForAllSizes([&](int rows, int n) {
    std::vector<double> changed = rows_;
    kernels::AddToRows(changed.data(), kStride, rows, factor_.data(), x_.data(),
                       n);
    for (int i = 0; i <= kMaxRows; ++i) {
      for (int j = 0; j < kStride; ++j) {
        const double added = i < rows && j < n ? factor_[i] * x_[j] : 0;
        EXPECT_EQ(changed[i * kStride + j], Entry(i, j) + added) << i << j;
      }
    }
  });
}

TEST_F(KernelsTest, DotWithSizeIsTheDotAndTheSumOfMagnitudes) {
  ForAllSizes([&](int i, int n) {
    double sum = 0, sum_of_magnitudes = 0;
    for (int j = 0; j < n; ++j) {
      sum += Entry(i, j) * x_[j];
      sum_of_magnitudes += std::abs(Entry(i, j) * x_[j]);
    }
    double dot = kUntouched, size = kUntouched;
    kernels::DotWithSize(&rows_[i * kStride], x_.data(), n, &dot, &size);
    EXPECT_EQ(dot, sum);
    EXPECT_EQ(size, sum_of_magnitudes);
  });
}

// A product with the divisor is the dividend, but for half a unit in the last
// place of the quotient and of the product. The same holds for the quotient of
// such a product, in place.
TEST_F(KernelsTest, DivideIsTheInverseOfMultiplication) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  for (const double divisor : {3.0, -0.7, 1e-9, 4.1e12}) {
    for (int n = 0; n <= kMaxSize; ++n) {
      std::vector<double> out(kStride, kUntouched), multiples = x_;
      kernels::Divide(x_.data(), divisor, n, out.data());
      for (int j = 0; j < n; ++j) multiples[j] *= divisor;
      kernels::Divide(multiples.data(), divisor, n, multiples.data());
      for (int j = 0; j < n; ++j) {
        EXPECT_NEAR(out[j] * divisor, x_[j], kEpsilon * std::abs(x_[j])) << j;
        EXPECT_NEAR(multiples[j], x_[j], kEpsilon * std::abs(x_[j])) << j;
      }
      for (int j = n; j < kStride; ++j) {
        EXPECT_EQ(out[j], kUntouched) << j;
        EXPECT_EQ(multiples[j], x_[j]) << j;
      }
    }
  }
}

// The squared length of all rows is the sum over the columns. A column alone is
// checked with a matrix that has no other one.
TEST_F(KernelsTest, ColumnSquaresSumToTheSquaredLengthOfTheRows) {
  ForAllSizes([&](int rows, int n) {
    std::vector<double> sums(kStride, kUntouched);
    kernels::ColumnSquares(rows_.data(), kStride, rows, n, sums.data());
    double left = 0;
    for (int i = 0; i < rows; ++i) {
      left += kernels::SquaredNorm(&rows_[i * kStride], n);
    }
    for (int j = 0; j < n; ++j) {
      double sum;
      kernels::ColumnSquares(&rows_[j], kStride, rows, 1, &sum);
      EXPECT_EQ(sums[j], sum) << j;
      left -= sums[j];
    }
    EXPECT_EQ(left, 0);
    for (int j = n; j < kStride; ++j) EXPECT_EQ(sums[j], kUntouched) << j;
  });
}

TEST_F(KernelsTest, MultiplyEntriesLeavesOutSmallOnes) {
  for (int n = 0; n <= kMaxSize; ++n) {
    const double least = 0.5;
    std::vector<double> out(kStride, kUntouched);
    kernels::MultiplyEntries(x_.data(), factor_.data(), least, n, out.data());
    for (int j = 0; j < n; ++j) {
      const bool is_small = x_[j] > -least && x_[j] < least;
      EXPECT_EQ(out[j], is_small ? 0 : x_[j] * factor_[j]) << j;
    }
    for (int j = n; j < kStride; ++j) EXPECT_EQ(out[j], kUntouched) << j;
  }
}

// A vector scaled by a and the vector itself add up to the vector scaled by 1 +
// a, here in place.
TEST_F(KernelsTest, ScaleIsLinear) {
  for (int n = 0; n <= kMaxSize; ++n) {
    std::vector<double> scaled(kStride, kUntouched), more = x_;
    kernels::Scale(x_.data(), -3, n, scaled.data());
    kernels::Scale(more.data(), -2, n, more.data());
    for (int j = 0; j < n; ++j) EXPECT_EQ(more[j], scaled[j] + x_[j]) << j;
    for (int j = n; j < kStride; ++j) {
      EXPECT_EQ(scaled[j], kUntouched) << j;
      EXPECT_EQ(more[j], x_[j]) << j;
    }
  }
}

TEST_F(KernelsTest, AbsoluteSumIsTheSumOfMagnitudes) {
  for (int n = 0; n <= kMaxSize; ++n) {
    double sum = 0;
    for (int j = 0; j < n; ++j) sum += std::abs(x_[j]);
    EXPECT_EQ(kernels::AbsoluteSum(x_.data(), n), sum) << n;
  }
}

TEST_F(KernelsTest, AbsoluteSumIsNotFiniteIfAnEntryIsNot) {
  for (const double strange : {std::numeric_limits<double>::quiet_NaN(),
                               -std::numeric_limits<double>::infinity()}) {
    for (int j = 0; j < kMaxSize; ++j) {
      std::vector<double> x = x_;
      x[j] = strange;
      EXPECT_FALSE(std::isfinite(kernels::AbsoluteSum(x.data(), kMaxSize)))
          << j;
    }
  }
}

TEST_F(KernelsTest, LargestIgnoresNaN) {
  for (int j = 0; j < kMaxSize; ++j) {
    std::vector<double> x(kMaxSize, -2);
    x[j] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(kernels::Largest(x.data(), kMaxSize), 2) << j;
  }
}

TEST_F(KernelsTest, LargestIsTheLargestMagnitude) {
  for (int n = 0; n <= kMaxSize; ++n) {
    std::vector<double> magnitudes = {0};
    for (int j = 0; j < n; ++j) magnitudes.push_back(std::abs(x_[j]));
    std::sort(magnitudes.begin(), magnitudes.end());
    EXPECT_EQ(kernels::Largest(x_.data(), n), magnitudes.back()) << n;
  }
  for (const double sign : {-1.0, 1.0}) {
    for (int j = 0; j < kMaxSize; ++j) {
      std::vector<double> x = x_;
      x[j] = sign * 1e9;
      EXPECT_EQ(kernels::Largest(x.data(), kMaxSize), 1e9) << j;
    }
  }
}

// The result is compared with long double, also where squares underflow or
// overflow.
TEST(Length, IsTheRootOfTheSumOfSquares) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  const std::vector<double> parts{0,      1,      -3,   1e-20, 1e-139, 1e-141,
                                  1e-160, 1e-300, 1e20, 1e139, -1e141, 1e300};
  for (const double x : parts) {
    for (const double y : parts) {
      const long double square_x = static_cast<long double>(x) * x;
      const long double square_y = static_cast<long double>(y) * y;
      const auto length = static_cast<double>(std::sqrt(square_x + square_y));
      EXPECT_NEAR(kernels::Length(x, y), length, 2 * kEpsilon * length)
          << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace poise
