// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/lexicographic_factorization.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "poise/tests/util/lexicographic.h"
#include "poise/tests/util/stacked_rows.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr int kSeeds = 300;
constexpr int kMaxRows = 24, kMaxLevels = 4;  // As MakeRandomLevels().

class RandomLexicographicFactorizationTest
    : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    for (const LeastSquares& level : levels_) AddLevel(level, &stack_);
  }
  // Rounding of numbers up to 10, multiplied by the squared condition of a
  // level.
  double Tolerance() const {
    return Rounding(10, kMaxRows, optimum_.condition * optimum_.condition);
  }
  double Residual(int level, int i) const {
    return levels_[level].A.row(i) * optimum_.y - levels_[level].b[i];
  }

  const std::vector<LeastSquares> levels_ = MakeRandomLevels(GetParam());
  const int n_ = static_cast<int>(levels_[0].A.cols());
  const int num_levels_ = static_cast<int>(levels_.size());
  const LexicographicOptimum optimum_ = SolveLexicographically(n_, levels_);
  LexicographicFactorization stack_{n_, kMaxRows, kMaxLevels};
};

TEST_P(RandomLexicographicFactorizationTest, AgreesWithSingularValues) {
  const Eigen::MatrixXd Q = Basis(stack_, n_);
  EXPECT_LE((Q * Q.transpose() -
             Eigen::MatrixXd::Identity(stack_.rank(), stack_.rank()))
                .norm(),
            Rounding(1, n_));
  EXPECT_LE((Optimum(stack_, n_) - optimum_.y).norm(), Tolerance());
  EXPECT_NEAR(stack_.norm_z(), optimum_.y.norm(), Tolerance());
  ASSERT_EQ(stack_.num_levels(), num_levels_);
  int row = 0;
  for (int l = 0; l < num_levels_; ++l) {
    const auto count = static_cast<int>(levels_[l].A.rows());
    const int before = l == 0 ? 0 : optimum_.rank[l - 1];
    EXPECT_EQ(stack_.rank(l), optimum_.rank[l]) << l;
    EXPECT_EQ(stack_.first_row(l), row) << l;
    EXPECT_EQ(stack_.end_row(l), row + count) << l;
    EXPECT_EQ(stack_.is_deficient(l), optimum_.rank[l] - before < count) << l;
    for (int i = 0; i < count; ++i) {
      const double residual = stack_.residual(row + i);
      if (stack_.is_deficient(l)) {
        EXPECT_NEAR(residual, Residual(l, i), Tolerance()) << l << ", " << i;
      } else {
        EXPECT_EQ(residual, 0) << l << ", " << i;
      }
    }
    row += count;
  }
  EXPECT_EQ(stack_.num_rows(), row);
  EXPECT_EQ(stack_.rank(), optimum_.rank.back());
}

TEST_P(RandomLexicographicFactorizationTest, HasTheGradientOfItsRows) {
  const Eigen::MatrixXd Q = Basis(stack_, n_);
  for (int l = 0; l < num_levels_; ++l) {
    const int rank = l == 0 ? 0 : optimum_.rank[l - 1];
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(n_);
    double size = 0;
    for (int i = 0; i < levels_[l].A.rows(); ++i) {
      const double weighted = levels_[l].weight[i] * Residual(l, i);
      expected += weighted * levels_[l].A.row(i).transpose();
      size = std::max(size, std::abs(weighted));
    }
    Eigen::VectorXd gradient = Eigen::VectorXd::Constant(rank + 1, 5);
    const double found = stack_.Gradient(l, gradient.data());
    EXPECT_LE((gradient.head(rank) - Q.topRows(rank) * expected).norm(),
              100 * Tolerance())
        << l;
    EXPECT_EQ(gradient[rank], 5) << l;
    if (found != 0) {
      EXPECT_NEAR(found, size, 100 * Tolerance()) << l;
    } else {
      EXPECT_LE((Q.topRows(rank) * expected).norm(), 100 * Tolerance()) << l;
    }
  }
}

TEST_P(RandomLexicographicFactorizationTest,
       MultipliersAddUpToAnyForceOnTheirRows) {
  const Eigen::MatrixXd Q = Basis(stack_, n_);
  for (int l = 0; l <= num_levels_; ++l) {
    const int rank = l == 0 ? 0 : optimum_.rank[l - 1];
    const int rows = l == 0 ? 0 : stack_.end_row(l - 1);
    Eigen::VectorXd force(rank), nu = Eigen::VectorXd::Constant(rows + 1, 5);
    for (int e = 0; e < rank; ++e) force[e] = 3 - e % 7;
    Eigen::VectorXd sum = Q.topRows(rank).transpose() * force;
    stack_.SolveDual(l, force.data(), nu.data());
    for (int above = 0; above < l; ++above) {
      const int first = stack_.first_row(above);
      for (int i = 0; i < levels_[above].A.rows(); ++i) {
        sum -= nu[first + i] * levels_[above].A.row(i).transpose();
      }
    }
    EXPECT_LE(sum.norm(), Tolerance()) << l;
    EXPECT_EQ(nu[rows], 5) << l;
  }
}

TEST_P(RandomLexicographicFactorizationTest, CorrectsAnyStartToTheSameOptimum) {
  // From any y in the row space, the residuals lead back to the optimum.
  const Eigen::MatrixXd Q = Basis(stack_, n_);
  Eigen::VectorXd z = Eigen::VectorXd::Map(stack_.z(), stack_.rank());
  for (int e = 0; e < stack_.rank(); ++e) z[e] += 1 + e % 3;
  const Eigen::VectorXd y = Q.transpose() * z;
  Eigen::VectorXd residual(stack_.num_rows());
  for (int l = 0; l < num_levels_; ++l) {
    residual.segment(stack_.first_row(l), levels_[l].A.rows()) =
        levels_[l].b - levels_[l].A * y;
  }
  Eigen::VectorXd change = Eigen::VectorXd::Constant(stack_.rank() + 1, 5);
  stack_.Correct(residual.data(), change.data());
  EXPECT_LE(
      (y + Q.transpose() * change.head(stack_.rank()) - optimum_.y).norm(),
      10 * Tolerance());
  EXPECT_EQ(change[stack_.rank()], 5);
}

TEST_P(RandomLexicographicFactorizationTest, RestoresLevelsAfterTruncation) {
  const Eigen::VectorXd y = Optimum(stack_, n_);
  for (int from = num_levels_; from >= 0; --from) {
    stack_.Truncate(from);
    ASSERT_EQ(stack_.num_levels(), from);
    EXPECT_EQ(stack_.rank(), from == 0 ? 0 : optimum_.rank[from - 1]);
    EXPECT_EQ(stack_.num_rows(), from == 0 ? 0 : stack_.end_row(from - 1));
    stack_.Truncate(from + 1);  // Removes no level.
    ASSERT_EQ(stack_.num_levels(), from);
    for (int l = from; l < num_levels_; ++l) AddLevel(levels_[l], &stack_);
    EXPECT_EQ(Optimum(stack_, n_), y) << from;
  }
}

// The levels before the first deficient one are merged, and rows of the merged
// level are removed and appended. The test keeps a copy of the rows in
// `merged_`.
class UpdatedLexicographicFactorizationTest
    : public RandomLexicographicFactorizationTest {
 protected:
  void SetUp() override {
    RandomLexicographicFactorizationTest::SetUp();
    while (met_ < num_levels_ && !stack_.is_deficient(met_)) ++met_;
    if (met_ == 0) return;
    stack_.Merge(met_);
    LeastSquares& merged = merged_[0];
    const int count = stack_.num_rows();
    merged.A.resize(count, n_);
    merged.b.resize(count);
    merged.weight.setOnes(count);
    for (int l = 0, row = 0; l < met_; ++l) {
      for (int i = 0; i < levels_[l].A.rows(); ++i, ++row) {
        merged.A.row(row) = levels_[l].A.row(i);
        merged.b[row] = levels_[l].b[i];
      }
    }
    merged_.insert(merged_.end(), levels_.begin() + met_, levels_.end());
  }
  // The last row gets the number of the removed row.
  void RemoveRow(int a) {
    LeastSquares& merged = merged_[0];
    const auto last = merged.A.rows() - 1;
    stack_.RemoveRow(a);
    ASSERT_EQ(stack_.num_rows(), last);
    merged.A.row(a) = Eigen::RowVectorXd(merged.A.row(last));
    merged.b[a] = merged.b[last];
    merged.A.conservativeResize(last, n_);
    merged.b.conservativeResize(last);
    merged.weight.conservativeResize(last);
  }
  void AppendRow(const Eigen::RowVectorXd& row, double target) {
    LeastSquares& merged = merged_[0];
    const int a = stack_.AddRow(target, 1);
    const auto end = merged.A.rows();
    ASSERT_EQ(a, end);
    Eigen::VectorXd::Map(stack_.row(a), n_) = row;
    ASSERT_TRUE(stack_.AppendRow());
    merged.A.conservativeResize(end + 1, n_);
    merged.b.conservativeResize(end + 1);
    merged.weight.setOnes(end + 1);
    merged.A.row(end) = row;
    merged.b[end] = target;
  }
  // Adds the other levels, compares the optimum with the one by singular
  // values, and removes these levels again.
  void Check();
  // Expects that the multipliers of the merged level reproduce a force on its
  // rows.
  void CheckDual(const Eigen::MatrixXd& Q, double tolerance);
  // Expects that a correction changes each row by the residual with the number
  // of the row.
  void CheckCorrection(const Eigen::MatrixXd& Q, double tolerance);

  int met_ = 0;  // Levels before the first deficient one.
  std::vector<LeastSquares> merged_{LeastSquares()};
};

void UpdatedLexicographicFactorizationTest::Check() {
  stack_.SolveLast();
  for (size_t l = 1; l < merged_.size(); ++l) AddLevel(merged_[l], &stack_);
  const auto rows = static_cast<int>(merged_[0].A.rows());
  const LexicographicOptimum optimum = SolveLexicographically(n_, merged_);
  const double tolerance =
      Rounding(10, kMaxRows, optimum.condition * optimum.condition);
  ASSERT_EQ(stack_.end_row(met_ - 1), rows);
  ASSERT_EQ(stack_.rank(met_ - 1), rows);
  const Eigen::MatrixXd Q = Basis(stack_, n_);
  EXPECT_LE((Q * Q.transpose() -
             Eigen::MatrixXd::Identity(stack_.rank(), stack_.rank()))
                .norm(),
            Rounding(1, n_));
  EXPECT_LE((Optimum(stack_, n_) - optimum.y).norm(), tolerance);
  for (int a = 0; a < rows; ++a) EXPECT_EQ(stack_.residual(a), 0) << a;
  CheckDual(Q, tolerance);
  CheckCorrection(Q, tolerance);
  stack_.Truncate(met_);
}

void UpdatedLexicographicFactorizationTest::CheckDual(const Eigen::MatrixXd& Q,
                                                      double tolerance) {
  const auto rows = static_cast<int>(merged_[0].A.rows());
  Eigen::VectorXd force = Eigen::VectorXd::LinSpaced(rows, 1, 2), nu(rows);
  const Eigen::VectorXd sum = Q.topRows(rows).transpose() * force;
  stack_.SolveDual(met_, force.data(), nu.data());
  EXPECT_LE((merged_[0].A.transpose() * nu - sum).norm(), tolerance);
}

void UpdatedLexicographicFactorizationTest::CheckCorrection(
    const Eigen::MatrixXd& Q, double tolerance) {
  const auto rows = static_cast<int>(merged_[0].A.rows());
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(stack_.num_rows());
  Eigen::VectorXd change(stack_.rank());
  for (int a = 0; a < rows; ++a) residual[a] = 1 + a;
  stack_.Correct(residual.data(), change.data());
  EXPECT_LE((merged_[0].A * Q.topRows(rows).transpose() * change.head(rows) -
             residual.head(rows))
                .norm(),
            tolerance);
}

TEST_P(UpdatedLexicographicFactorizationTest, AgreesWithSingularValues) {
  if (met_ == 0) return;
  ASSERT_EQ(stack_.num_levels(), met_);
  const int count = stack_.num_rows();
  EXPECT_EQ(stack_.rank(), count);
  EXPECT_EQ(stack_.first_row(met_ - 1), 0);
  for (int removed = 0; removed < count; ++removed) {
    SCOPED_TRACE(removed);
    const LeastSquares all = merged_[0];
    std::vector<int> gone;  // By number in `all`.
    for (int a = removed; a >= 0; a -= 2) {
      gone.push_back(a);
      RemoveRow(a);
      Check();
    }
    for (const int from : gone) {
      AppendRow(all.A.row(from), all.b[from]);
      Check();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomLexicographicFactorizationTest,
                         testing::Range(0, kSeeds));
INSTANTIATE_TEST_SUITE_P(Seeds, UpdatedLexicographicFactorizationTest,
                         testing::Range(0, kSeeds));

}  // namespace
}  // namespace poise
