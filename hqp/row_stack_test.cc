// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "hqp/row_stack.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "hqp/row_space.h"
#include "tests/util/count_malloc.h"
#include "tests/util/lexicographic.h"
#include "tests/util/tolerance.h"

namespace poise {
namespace {

constexpr int kSeeds = 300;
constexpr int kMaxRows = 24, kMaxLevels = 4;  // Of MakeRandomLevels().

void AddLevel(const LeastSquares& level, RowStack* stack) {
  for (int i = 0; i < level.A.rows(); ++i) {
    const int a = stack->AddRow(level.b[i], std::sqrt(level.weight[i]));
    Eigen::VectorXd::Map(stack->row(a), level.A.cols()) = level.A.row(i);
  }
  stack->FactorLevel();
}

Eigen::MatrixXd Basis(const RowStack& stack, int n) {
  Eigen::MatrixXd Q(stack.rank(), n);
  for (int i = 0; i < stack.rank(); ++i) {
    Q.row(i) = Eigen::RowVectorXd::Map(stack.basis() + i * stack.stride(), n);
  }
  return Q;
}

Eigen::VectorXd Optimum(const RowStack& stack, int n) {
  return Basis(stack, n).transpose() *
         Eigen::VectorXd::Map(stack.z(), stack.rank());
}

class RandomRowStackTest : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    for (const LeastSquares& level : levels_) AddLevel(level, &stack_);
  }
  // Of numbers up to 10, through a level's condition, twice.
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
  RowStack stack_{n_, kMaxRows, kMaxLevels};
};

TEST_P(RandomRowStackTest, AgreesWithSingularValues) {
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

TEST_P(RandomRowStackTest, HasTheGradientOfItsRows) {
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

TEST_P(RandomRowStackTest, MultipliersAddUpToAnyForceOnTheirRows) {
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

TEST_P(RandomRowStackTest, CorrectsAnyStartToTheSameOptimum) {
  // From a y anywhere in the rows' space, what they lack leads back.
  const Eigen::MatrixXd Q = Basis(stack_, n_);
  Eigen::VectorXd z = Eigen::VectorXd::Map(stack_.z(), stack_.rank());
  for (int e = 0; e < stack_.rank(); ++e) z[e] += 1 + e % 3;
  const Eigen::VectorXd y = Q.transpose() * z;
  Eigen::VectorXd lack(stack_.num_rows());
  for (int l = 0; l < num_levels_; ++l) {
    lack.segment(stack_.first_row(l), levels_[l].A.rows()) =
        levels_[l].b - levels_[l].A * y;
  }
  Eigen::VectorXd change = Eigen::VectorXd::Constant(stack_.rank() + 1, 5);
  stack_.Correct(lack.data(), change.data());
  EXPECT_LE(
      (y + Q.transpose() * change.head(stack_.rank()) - optimum_.y).norm(),
      10 * Tolerance());
  EXPECT_EQ(change[stack_.rank()], 5);
}

TEST_P(RandomRowStackTest, LevelsComeBackAfterTheyWereDropped) {
  const Eigen::VectorXd y = Optimum(stack_, n_);
  for (int from = num_levels_; from >= 0; --from) {
    stack_.Truncate(from);
    ASSERT_EQ(stack_.num_levels(), from);
    EXPECT_EQ(stack_.rank(), from == 0 ? 0 : optimum_.rank[from - 1]);
    EXPECT_EQ(stack_.num_rows(), from == 0 ? 0 : stack_.end_row(from - 1));
    stack_.Truncate(from + 1);  // Drops nothing.
    ASSERT_EQ(stack_.num_levels(), from);
    for (int l = from; l < num_levels_; ++l) AddLevel(levels_[l], &stack_);
    EXPECT_EQ(Optimum(stack_, n_), y) << from;
  }
}

// Rows of the levels that are met go, each in turn and then with it the ones
// before it, and come back; so do levels after them. What is left is solved as
// if it had been all.
TEST_P(RandomRowStackTest, UpdatesAreAsGoodAsFactorisingAnew) {
  int met = 0;
  while (met < num_levels_ && !stack_.is_deficient(met)) ++met;
  if (met == 0) return;
  stack_.Merge(met);
  ASSERT_EQ(stack_.num_levels(), met);
  const int count = stack_.num_rows();
  EXPECT_EQ(stack_.rank(), count);
  EXPECT_EQ(stack_.first_row(met - 1), 0);
  std::vector<LeastSquares> levels(levels_.begin() + (met - 1), levels_.end());
  LeastSquares& first = levels[0];
  first.A.resize(count, n_);
  first.b.resize(count);
  first.weight.setOnes(count);
  for (int l = 0, row = 0; l < met; ++l) {
    for (int i = 0; i < levels_[l].A.rows(); ++i, ++row) {
      first.A.row(row) = levels_[l].A.row(i);
      first.b[row] = levels_[l].b[i];
    }
  }
  const auto check = [&] {
    stack_.SolveLast();
    for (size_t l = 1; l < levels.size(); ++l) AddLevel(levels[l], &stack_);
    const int rows = static_cast<int>(first.A.rows());
    const LexicographicOptimum optimum = SolveLexicographically(n_, levels);
    const double tolerance =
        Rounding(10, kMaxRows, optimum.condition * optimum.condition);
    ASSERT_EQ(stack_.end_row(met - 1), rows);
    ASSERT_EQ(stack_.rank(met - 1), rows);
    const Eigen::MatrixXd Q = Basis(stack_, n_);
    EXPECT_LE((Q * Q.transpose() -
               Eigen::MatrixXd::Identity(stack_.rank(), stack_.rank()))
                  .norm(),
              Rounding(1, n_));
    EXPECT_LE((Optimum(stack_, n_) - optimum.y).norm(), tolerance);
    Eigen::VectorXd force = Eigen::VectorXd::LinSpaced(rows, 1, 2), nu(rows);
    const Eigen::VectorXd sum = Q.topRows(rows).transpose() * force;
    stack_.SolveDual(met, force.data(), nu.data());
    EXPECT_LE((first.A.transpose() * nu - sum).norm(), tolerance);
    for (int a = 0; a < rows; ++a) EXPECT_EQ(stack_.residual(a), 0) << a;
    // What a row lacks, by its number.
    Eigen::VectorXd lack = Eigen::VectorXd::Zero(stack_.num_rows());
    Eigen::VectorXd change(stack_.rank());
    for (int a = 0; a < rows; ++a) lack[a] = 1 + a;
    stack_.Correct(lack.data(), change.data());
    EXPECT_LE((first.A * Q.topRows(rows).transpose() * change.head(rows) -
               lack.head(rows))
                  .norm(),
              tolerance);
    stack_.Truncate(met);
  };
  for (int removed = 0; removed < count; ++removed) {
    SCOPED_TRACE(removed);
    const LeastSquares all = first;
    std::vector<int> gone;  // By number in `all`.
    for (int a = removed; a >= 0; a -= 2) {
      const auto last = first.A.rows() - 1;
      gone.push_back(a);
      stack_.RemoveRow(a);
      ASSERT_EQ(stack_.num_rows(), last);
      first.A.row(a) = Eigen::RowVectorXd(first.A.row(last));
      first.b[a] = first.b[last];
      first.A.conservativeResize(last, n_);
      first.b.conservativeResize(last);
      first.weight.conservativeResize(last);
      check();
    }
    for (const int from : gone) {
      const int a = stack_.AddRow(all.b[from], 1);
      const auto end = first.A.rows();
      ASSERT_EQ(a, end);
      Eigen::VectorXd::Map(stack_.row(a), n_) = all.A.row(from);
      ASSERT_TRUE(stack_.AppendRow());
      first.A.conservativeResize(end + 1, n_);
      first.b.conservativeResize(end + 1);
      first.weight.setOnes(end + 1);
      first.A.row(end) = all.A.row(from);
      first.b[end] = all.b[from];
      check();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomRowStackTest, testing::Range(0, kSeeds));

// y1 = 1 twice and y1 = 3 once, in one level; then y1 = 5, y2 = 7.
class RowStackTest : public testing::Test {
 protected:
  RowStackTest() {
    LeastSquares first;
    first.A.resize(2, 2);
    first.A << 1, 0, 1, 0;
    first.b = Eigen::Vector2d(1, 3);
    first.weight = Eigen::Vector2d(1, 3);
    AddLevel(first, &stack_);
    LeastSquares second;
    second.A.setIdentity(2, 2);
    second.b = Eigen::Vector2d(5, 7);
    second.weight = Eigen::Vector2d(2, 4);
    AddLevel(second, &stack_);
  }
  RowStack stack_{2, 4, 2};
};

TEST_F(RowStackTest, SolvesByHand) {
  const Eigen::VectorXd y = Optimum(stack_, 2);
  EXPECT_NEAR(y[0], 2.5, Rounding(5, 2));
  EXPECT_NEAR(y[1], 7, Rounding(7, 2));
  EXPECT_NEAR(stack_.residual(0), 1.5, Rounding(5, 2));
  EXPECT_NEAR(stack_.residual(1), -0.5, Rounding(5, 2));
  EXPECT_NEAR(stack_.residual(2), -2.5, Rounding(5, 2));
  EXPECT_EQ(stack_.residual(3), 0);
  double gradient[1];
  EXPECT_NEAR(stack_.Gradient(1, gradient), 5, Rounding(5, 2));
  EXPECT_NEAR(gradient[0] * stack_.basis()[0], -5, Rounding(5, 2));
}

TEST_F(RowStackTest, MeetsIndependentRowsWhateverTheirMetric) {
  RowStack stack(2, 2, 1);
  LeastSquares level;
  level.A.resize(2, 2);
  level.A << 1, 0, 0.6, 0.8;
  level.b = Eigen::Vector2d(1, 2);
  level.weight = Eigen::Vector2d(1e-12, 1e12);
  AddLevel(level, &stack);
  EXPECT_LE((level.A * Optimum(stack, 2) - level.b).norm(), Rounding(2, 2, 4));
}

// Two rows at a small angle, in one level or in two.
TEST_F(RowStackTest, CountsARowOfWhichSomethingIsLeft) {
  for (const int num_levels : {1, 2}) {
    for (const double rest : {0.25, 10.0}) {
      RowStack stack(3, 2, 2);
      stack.AddRow(1, 1);
      Eigen::Vector3d::Map(stack.row(0)) << 0.6, 0.8, 0;
      if (num_levels == 2) stack.FactorLevel();
      const int a = stack.AddRow(1, 1);
      Eigen::Vector3d::Map(stack.row(a)) << 0.6, 0.8, rest * kRankTolerance;
      stack.FactorLevel();
      EXPECT_EQ(stack.rank(), rest > 1 ? 2 : 1) << num_levels << ", " << rest;
    }
  }
}

// What is left of such rows after one projection is far from orthogonal.
TEST_F(RowStackTest, OrthogonalisesWhatIsNearlyParallel) {
  constexpr int kSize = 6;
  for (const double angle : {0.5, 1e-2, 1e-5, 1e-8}) {
    for (const int rows_a_level : {1, 2, kSize}) {
      RowStack stack(kSize, kSize, kSize);
      for (int i = 0; i < kSize; ++i) {
        Eigen::VectorXd row = Eigen::VectorXd::Constant(kSize, 1);
        row[i] += angle * (1 + i);
        row.normalize();
        const int a = stack.AddRow(1, 1);
        Eigen::VectorXd::Map(stack.row(a), kSize) = row;
        if ((i + 1) % rows_a_level == 0) stack.FactorLevel();
      }
      ASSERT_EQ(stack.rank(), kSize);
      const Eigen::MatrixXd Q = Basis(stack, kSize);
      EXPECT_LE(
          (Q * Q.transpose() - Eigen::MatrixXd::Identity(kSize, kSize)).norm(),
          Rounding(1, kSize))
          << angle << ", " << rows_a_level;
    }
  }
}

// Less than a thousandth of it, or in a space that is full.
TEST_F(RowStackTest, AppendsNoRowThatNearlyDependsOnOthers) {
  for (const double rest : {0.5e-3, 2e-3}) {
    RowStack stack(2, 3, 1);
    stack.AddRow(1, 1);
    Eigen::Vector2d::Map(stack.row(0)) << 0.6, 0.8;
    stack.FactorLevel();
    Eigen::Vector2d::Map(stack.row(stack.AddRow(1, 1))) << 0.6 - 0.8 * rest,
        0.8 + 0.6 * rest;
    const bool is_good = rest > 1e-3;
    EXPECT_EQ(stack.AppendRow(), is_good) << rest;
    EXPECT_EQ(stack.num_rows(), is_good ? 2 : 1) << rest;
    EXPECT_EQ(stack.rank(), is_good ? 2 : 1) << rest;
    EXPECT_EQ(stack.is_well_conditioned(), true) << rest;
    if (!is_good) continue;
    Eigen::Vector2d::Map(stack.row(stack.AddRow(1, 1))) << 0, 1;
    EXPECT_FALSE(stack.AppendRow());
    EXPECT_EQ(stack.num_rows(), 2);
  }
}

TEST_F(RowStackTest, AResidualOfRoundingIsNone) {
  for (const double off : {1e-13, 1e-10}) {
    RowStack stack(1, 2, 2);
    stack.AddRow(1, 1);
    *stack.row(0) = 1;
    stack.FactorLevel();
    stack.AddRow(1 + off, 1);
    *stack.row(1) = 1;
    stack.FactorLevel();
    if (off < 1e-12) {
      EXPECT_EQ(stack.residual(1), 0);
    } else {
      EXPECT_NEAR(stack.residual(1), -off, Rounding(2, 2));
    }
  }
}

TEST_F(RowStackTest, TakesAResidualForTheGradient) {
  EXPECT_NEAR(stack_.weight(1), 3, Rounding(3, 1));
  EXPECT_NEAR(stack_.weight(2), 2, Rounding(2, 1));
  stack_.SetResidual(2, 10);
  EXPECT_EQ(stack_.residual(2), 10);
  double gradient[1];
  EXPECT_NEAR(stack_.Gradient(1, gradient), 20, Rounding(20, 2));
  EXPECT_NEAR(gradient[0] * stack_.basis()[0], 20, Rounding(20, 2));
}

TEST_F(RowStackTest, DoesNotAllocate) {
  RowStack stack(2, 4, 2);
  double force[2] = {1, 2}, nu[4], lack[4] = {}, change[2];
  const CountMalloc count;
  for (int repeat = 0; repeat < 2; ++repeat) {
    stack.Truncate(0);
    for (int a = 0; a < 4; ++a) {
      stack.AddRow(a, 1);
      stack.row(a)[0] = a % 2;
      stack.row(a)[1] = (a + 1) % 2;
      if (a % 2 == 1) stack.FactorLevel();
    }
    stack.Gradient(1, force);
    stack.SolveDual(2, force, nu);
    stack.Correct(lack, change);
    stack.Merge(1);
    stack.RemoveRow(0);
    stack.AddRow(1, 1);
    stack.row(1)[1] = 1;
    stack.row(1)[0] = 0;
    EXPECT_TRUE(stack.AppendRow());
    stack.SolveLast();
  }
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
