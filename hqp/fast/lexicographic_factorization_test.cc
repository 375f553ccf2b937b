// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/lexicographic_factorization.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "poise/tests/util/decompositions.h"
#include "poise/tests/util/lexicographic.h"
#include "poise/tests/util/stacked_rows.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr int kSeeds = 300;
// As MakeRandomLevels(), and for each variable a row that fixes it.
constexpr int kMaxRows = 24 + 9, kMaxLevels = 4;
constexpr double kIndependentPart = 1e-3;  // As documented for updates.

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

// A level that takes too many multiply-adds is not added, and its rows are
// removed. What was factored before stays, and the level can be added later.
TEST_P(RandomLexicographicFactorizationTest, RemovesALevelThatTakesTooLong) {
  const int last = num_levels_ - 1;
  stack_.Truncate(last);
  const Eigen::MatrixXd before = Basis(stack_, n_);
  const int rows = stack_.num_rows(), rank = stack_.rank();
  const std::int64_t start = stack_.multiply_adds();
  AddLevel(levels_[last], &stack_);
  const std::int64_t needed = stack_.multiply_adds() - start;
  int added = 0, removed = 0;
  for (int part = 0; part <= 8; ++part) {
    stack_.Truncate(last);
    const std::int64_t most = stack_.multiply_adds() + part * needed / 8;
    stack_.set_max_multiply_adds(most);
    AddLevel(levels_[last], &stack_);
    if (stack_.num_levels() == num_levels_) {
      ++added;
    } else {
      ++removed;
      EXPECT_GT(stack_.multiply_adds(), most);
      EXPECT_EQ(stack_.num_levels(), last);
      EXPECT_EQ(stack_.num_rows(), rows);
      EXPECT_EQ(stack_.rank(), rank);
      EXPECT_EQ(Basis(stack_, n_), before);
    }
  }
  EXPECT_GT(added, 0);
  // A level that those before determine takes no factorisation.
  EXPECT_TRUE(removed > 0 || needed == 0 || rank == n_);
  stack_.Truncate(last);
  stack_.set_max_multiply_adds(std::numeric_limits<std::int64_t>::max());
  AddLevel(levels_[last], &stack_);
  EXPECT_LE((Optimum(stack_, n_) - optimum_.y).norm(), Tolerance());
}

// For other targets, the same factors give what new factors give.
TEST_P(RandomLexicographicFactorizationTest, SolvesAgainForOtherTargets) {
  std::vector<LeastSquares> others = levels_;
  const int from = num_levels_ / 2;
  int row = 0;
  for (int l = 0; l < num_levels_; ++l) {
    for (int i = 0; i < others[l].b.size(); ++i, ++row) {
      if (l < from) continue;
      others[l].b[i] = 3 - i;
      // Rows of a factorisation have unit length.
      stack_.SetTarget(row, others[l].b[i] / others[l].A.row(i).norm());
    }
  }
  stack_.SolveFrom(from);
  LexicographicFactorization fresh(n_, kMaxRows, kMaxLevels);
  for (const LeastSquares& level : others) AddLevel(level, &fresh);
  EXPECT_LE((Optimum(stack_, n_) - Optimum(fresh, n_)).norm(), Tolerance());
  for (int i = 0; i < row; ++i) {
    EXPECT_NEAR(stack_.residual(i), fresh.residual(i), Tolerance()) << i;
  }
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
    for (int l = 0; l < met_; ++l) {
      for (int i = 0; i < levels_[l].A.rows(); ++i) {
        poise::AppendRow(levels_[l].A.row(i), levels_[l].b[i], &merged_[0]);
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
    const int a = stack_.AddRow(target, 1);
    ASSERT_EQ(a, merged_[0].A.rows());
    const Eigen::VectorXd entries = row;
    stack_.SetRow(a, entries.data(), 0, n_, 1);
    ASSERT_TRUE(stack_.AppendRow());
    poise::AppendRow(row, target, &merged_[0]);
  }
  // Expects that the variable can be fixed if its row is independent enough.
  void Fix(int variable, double entry, double target) {
    const Eigen::VectorXd row = entry * Eigen::VectorXd::Unit(n_, variable);
    const Eigen::MatrixXd At = merged_[0].A.transpose();
    double part = 1;
    if (At.cols() > 0) {
      part = (row - At * LeastSquaresSolution(At, row).x).norm();
    }
    stack_.AddRow(target, 1);
    const bool is_fixed = stack_.AppendFixedVariable(variable, entry);
    EXPECT_EQ(is_fixed, part > kIndependentPart) << part;
    ASSERT_EQ(stack_.variables().is_fixed(variable), is_fixed);
    if (is_fixed) poise::AppendRow(row, target, &merged_[0]);
  }
  // The projections of the other levels are kept in every other test. They are
  // orthogonal to the merged level to within three digits of rounding.
  bool KeepsProjections() const { return GetParam() % 2 == 0; }
  void AddOtherLevels();
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
  AddOtherLevels();
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
            KeepsProjections() ? 100 * Rounding(1, n_) : Rounding(1, n_));
  EXPECT_LE((Optimum(stack_, n_) - optimum.y).norm(), tolerance);
  for (int a = 0; a < rows; ++a) EXPECT_EQ(stack_.residual(a), 0) << a;
  const std::int64_t work = stack_.multiply_adds();
  CheckDual(Q, tolerance);
  EXPECT_GE(stack_.multiply_adds(), work);
  CheckCorrection(Q, tolerance);
  EXPECT_GE(stack_.multiply_adds(), work);
  stack_.Truncate(met_);
}

void UpdatedLexicographicFactorizationTest::AddOtherLevels() {
  int key = 0;
  for (size_t l = 1; l < merged_.size(); ++l) {
    const LeastSquares& level = merged_[l];
    for (int i = 0; i < level.A.rows(); ++i, ++key) {
      const int a = stack_.AddRow(level.b[i], std::sqrt(level.weight[i]));
      if (KeepsProjections() && stack_.Recall(a, key)) continue;
      const Eigen::VectorXd row = level.A.row(i);
      stack_.SetRow(a, row.data(), 0, n_, 1);
    }
    stack_.FactorLevel();
  }
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

// All variables are fixed that can be. Then rows are removed, fixed variables
// and others, and variables are fixed again.
TEST_P(UpdatedLexicographicFactorizationTest, FixesAndReleasesVariables) {
  if (met_ == 0) return;
  for (int turn = 0; turn < 3; ++turn) {
    SCOPED_TRACE(turn);
    for (int k = 0; k < n_; ++k) {
      const int j = (k + turn) % n_;
      if (stack_.variables().is_fixed(j)) continue;
      Fix(j, (j + turn) % 2 == 0 ? 1 : -1, 5 - j);
      Check();
    }
    const int count = stack_.num_rows();
    for (int removed = 0; removed < std::min(count, n_ - turn); ++removed) {
      RemoveRow((7 * removed + GetParam()) % stack_.num_rows());
      if (stack_.num_rows() == 0) break;
      Check();
    }
    if (stack_.num_rows() == 0) return;
  }
}

TEST_P(UpdatedLexicographicFactorizationTest, RefusesAFixedVariable) {
  if (met_ == 0) return;
  for (int j = 0; j < n_; ++j) {
    Fix(j, 1, 2);
    if (!stack_.variables().is_fixed(j)) continue;
    const int rows = stack_.num_rows();
    stack_.AddRow(2, 1);
    EXPECT_FALSE(stack_.AppendFixedVariable(j, -1));
    EXPECT_EQ(stack_.num_rows(), rows);
  }
}

// The merged level is factored at once, with fixed variables first.
TEST_P(UpdatedLexicographicFactorizationTest, FactorsFixedVariablesAtOnce) {
  if (met_ == 0) return;
  LeastSquares all;
  stack_.Truncate(0);
  for (int j = GetParam() % 4; j < n_; j += 1 + GetParam() % 3) {
    const int a = stack_.AddFixedVariable(j, j % 2 == 0 ? 1 : -1, j, 1);
    EXPECT_EQ(a, all.A.rows());
    poise::AppendRow((j % 2 == 0 ? 1 : -1) * Eigen::RowVectorXd::Unit(n_, j), j,
                     &all);
  }
  for (int i = 0; i < merged_[0].A.rows(); ++i) {
    AddRow(merged_[0], i, &stack_);
    poise::AppendRow(merged_[0].A.row(i), merged_[0].b[i], &all);
  }
  if (all.A.rows() == 0) return;
  const Eigen::VectorXd sigma = JacobiSvd(all.A).sigma;
  if (!stack_.FactorMerged(met_)) {
    // The least singular value is at most the independent part of any row.
    EXPECT_TRUE(all.A.rows() > n_ || sigma.minCoeff() < kIndependentPart);
    EXPECT_EQ(stack_.num_rows(), 0);
    EXPECT_EQ(stack_.rank(), 0);
    EXPECT_EQ(stack_.num_levels(), 0);
    EXPECT_EQ(stack_.variables().size(), 0);
    return;
  }
  ASSERT_LE(all.A.rows(), n_);
  // The product of the independent parts is that of the singular values.
  EXPECT_GE(sigma.array().log().sum(),
            static_cast<double>(sigma.size()) * std::log(kIndependentPart));
  merged_[0] = all;
  Check();
  RemoveRow(0);
  if (stack_.num_rows() > 0) Check();
}

// Q y and y + Q' z agree with the explicit basis.
TEST_P(UpdatedLexicographicFactorizationTest, MultipliesByTheBasis) {
  if (met_ == 0) return;
  for (int j = 0; j < n_; j += 2) Fix(j, -1, 1);
  const Eigen::MatrixXd Q = Basis(stack_, n_);
  const Eigen::VectorXd y = Eigen::VectorXd::LinSpaced(n_, -1, 3);
  for (int rank = 0; rank <= stack_.rank(); ++rank) {
    Eigen::VectorXd z = Eigen::VectorXd::Constant(n_ + 1, 5), sum = y;
    stack_.Project(y.data(), rank, z.data());
    EXPECT_LE((z.head(rank) - Q.topRows(rank) * y).norm(),
              Rounding(y.norm(), n_));
    EXPECT_EQ(z[rank], 5);
    stack_.AddCombination(z.data(), rank, sum.data());
    EXPECT_LE((sum - y - Q.topRows(rank).transpose() * z.head(rank)).norm(),
              Rounding(2 * y.norm(), n_));
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomLexicographicFactorizationTest,
                         testing::Range(0, kSeeds));
INSTANTIATE_TEST_SUITE_P(Seeds, UpdatedLexicographicFactorizationTest,
                         testing::Range(0, kSeeds));

}  // namespace
}  // namespace poise
