// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/diagonal_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "poise/tests/util/decompositions.h"
#include "poise/tests/util/lexicographic.h"
#include "poise/tests/util/stacked_rows.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr int kSeeds = 300;
// As MakeRandomLevels(), and for each variable a row that fixes it.
constexpr int kMaxRows = 24 + 9, kMaxLeadingLevels = 4;
constexpr int kMaxDiagonalLevels = 3;

// One row of a diagonal level.
struct Selection {
  int variable;
  double weight, target;
};

// Returns the level as rows of a least-squares problem.
LeastSquares Rows(const std::vector<Selection>& level, int n) {
  const auto count = static_cast<int>(level.size());
  LeastSquares rows;
  rows.A.setZero(count, n);
  rows.b.resize(count);
  rows.weight.resize(count);
  for (int i = 0; i < count; ++i) {
    rows.A(i, level[i].variable) = 1;
    rows.b[i] = level[i].target;
    rows.weight[i] = level[i].weight;
  }
  return rows;
}

// Returns random diagonal levels. A variable may occur twice, on one level or
// on two.
std::vector<std::vector<Selection>> MakeSelections(int seed, int n) {
  std::mt19937 random(seed);
  const auto below = [&](int bound) {
    return static_cast<int>(random() % static_cast<unsigned>(bound));
  };
  std::vector<std::vector<Selection>> levels(1 + below(kMaxDiagonalLevels));
  for (std::vector<Selection>& level : levels) {
    level.resize(1 + below(n));
    // On half of the levels, most weights are equal.
    const bool has_usual = below(2) == 0;
    for (Selection& row : level) {
      row = {below(n), 1 + below(100) / 10.0, below(21) - 10.0};
      if (has_usual && below(4) > 0) row.weight = 2.5;
    }
  }
  return levels;
}

class RandomDiagonalLevelsTest : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    const bool fixes = GetParam() % 2 == 1 && FactorFixed();
    for (int l = fixes ? 1 : 0; l < num_leading_levels_; ++l) {
      AddLevel(levels_[l], &leading_);
    }
    for (const std::vector<Selection>& level : selections_) {
      diagonal_.AddLevel();
      for (const Selection& row : level) {
        diagonal_.Add(row.variable, row.weight, row.target);
      }
      levels_.push_back(Rows(level, n_));
    }
    diagonal_.Finish(nullptr);
    std::vector<Selection> rest;
    for (int j = 0; j < n_; ++j) rest.push_back({j, 1, 0});
    selections_.push_back(rest);
    levels_.push_back(Rows(rest, n_));
    optimum_ = SolveLexicographically(n_, levels_);
    diagonal_.Solve(leading_, y_.data());
  }
  // Fixes some variables on the first level. Returns false if its rows depend
  // on them.
  bool FactorFixed() {
    LeastSquares first = levels_[0];
    for (int j = GetParam() % 3; j < n_; j += 2 + GetParam() % 5) {
      leading_.AddFixedVariable(j, j % 2 == 0 ? 1 : -1, j - 3, 1);
      AppendRow((j % 2 == 0 ? 1 : -1) * Eigen::VectorXd::Unit(n_, j), j - 3,
                &first);
    }
    for (int i = 0; i < levels_[0].A.rows(); ++i) {
      AddRow(levels_[0], i, &leading_);
    }
    if (!leading_.FactorMerged(1)) {
      // The least singular value is at most the independent part of any row,
      // and FactorMerged() refuses parts below 1e-3.
      EXPECT_TRUE(first.A.rows() > n_ ||
                  JacobiSvd(first.A).sigma.minCoeff() < 1e-3);
      return false;
    }
    levels_[0] = first;
    return true;
  }
  Eigen::MatrixXd Basis() const { return poise::Basis(leading_, n_); }
  void Fill(DiagonalLevels* diagonal) const {
    for (size_t l = 0; l + 1 < selections_.size(); ++l) {
      diagonal->AddLevel();
      for (const Selection& row : selections_[l]) {
        diagonal->Add(row.variable, row.weight, row.target);
      }
    }
    diagonal->Finish(nullptr);
  }
  double Tolerance() const {
    return Rounding(10, kMaxRows, optimum_.condition * optimum_.condition);
  }

  std::vector<LeastSquares> levels_ = MakeRandomLevels(GetParam());
  const int n_ = static_cast<int>(levels_[0].A.cols());
  const int num_leading_levels_ = static_cast<int>(levels_.size());
  std::vector<std::vector<Selection>> selections_ =
      MakeSelections(GetParam(), n_);
  LexicographicFactorization leading_{n_, kMaxRows, kMaxLeadingLevels};
  DiagonalLevels diagonal_{n_, kMaxDiagonalLevels};
  LexicographicOptimum optimum_;
  Eigen::VectorXd y_ = Eigen::VectorXd::Zero(n_);
};

TEST_P(RandomDiagonalLevelsTest, AgreesWithSingularValues) {
  EXPECT_LE((y_ - optimum_.y).norm(), Tolerance());
  ASSERT_EQ(diagonal_.num_levels(), static_cast<int>(selections_.size()));
  for (int l = 0; l < diagonal_.num_levels(); ++l) {
    EXPECT_EQ(diagonal_.Nullity(l), n_ - optimum_.rank[num_leading_levels_ + l])
        << l;
  }
  for (int j = 0; j < n_; ++j) {
    int first = 0;
    const auto has = [&](int level) {
      for (const Selection& row : selections_[level]) {
        if (row.variable == j) return true;
      }
      return false;
    };
    while (!has(first)) ++first;
    EXPECT_EQ(diagonal_.level(j), first) << j;
  }
}

TEST_P(RandomDiagonalLevelsTest, MultipliersCancelTheGradient) {
  const Eigen::MatrixXd Q = Basis();
  for (int l = 0; l < diagonal_.num_levels(); ++l) {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(n_);
    Eigen::VectorXd size = Eigen::VectorXd::Zero(n_);
    for (const Selection& row : selections_[l]) {
      if (diagonal_.level(row.variable) != l) continue;
      gradient[row.variable] += row.weight * (y_[row.variable] - row.target);
      size[row.variable] += row.weight * 10;
    }
    const double tolerance = Tolerance() * (1 + size.sum());
    Eigen::VectorXd on_leading = Eigen::VectorXd::Constant(leading_.rank(), 5);
    Eigen::VectorXd left = Eigen::VectorXd::Constant(n_, 5);
    if (diagonal_.Dual(leading_, l, on_leading.data(), left.data()) == 0) {
      EXPECT_LE(gradient.norm(), tolerance) << l;
      continue;
    }
    const Eigen::VectorXd sum = gradient + Q.transpose() * on_leading;
    for (int j = 0; j < n_; ++j) {
      const bool is_earlier = diagonal_.level(j) < l;
      EXPECT_NEAR(sum[j], is_earlier ? left[j] : 0, tolerance)
          << l << ", " << j;
      if (!is_earlier) {
        EXPECT_EQ(left[j], 5) << l << ", " << j;
      }
    }
  }
}

TEST_P(RandomDiagonalLevelsTest, SplitsTheGradientIntoLeadingRowsAndTheRest) {
  const Eigen::MatrixXd Q = Basis();
  for (int l = 0; l < diagonal_.num_levels(); ++l) {
    Eigen::VectorXd on_leading(leading_.rank()),
        left = Eigen::VectorXd::Zero(n_);
    if (diagonal_.Dual(leading_, l, on_leading.data(), left.data()) == 0)
      continue;
    Eigen::VectorXd sum = Eigen::VectorXd::Constant(n_, 1);
    diagonal_.AddGradient(l, y_.data(), left.data(), sum.data());
    sum.array() -= 1;
    EXPECT_LE((sum + Q.transpose() * on_leading).norm(), 1000 * Tolerance())
        << l;
  }
}

TEST_P(RandomDiagonalLevelsTest, CorrectsAnyStartToTheSameOptimum) {
  const Eigen::MatrixXd Q = Basis();
  Eigen::VectorXd y = y_;
  for (int j = 0; j < n_; ++j) y[j] += 1 + j % 3;
  const Eigen::VectorXd change = Q * (y_ - y);
  Eigen::VectorXd nearest = y;
  diagonal_.Correct(leading_, change.data(), true, y.data());
  EXPECT_LE((y - y_).norm(), 10 * Tolerance());
  // Without a step to the minimum, the leading levels are still met.
  diagonal_.Correct(leading_, change.data(), false, nearest.data());
  EXPECT_LE((Q * (nearest - y_)).norm(), 10 * Tolerance());
}

TEST_P(RandomDiagonalLevelsTest, CorrectsByTheMinimumNorm) {
  // The step depends on weights and levels, but not on targets. So the step is
  // the optimum of the levels with all targets zero.
  const Eigen::MatrixXd Q = Basis();
  const Eigen::VectorXd change =
      Eigen::VectorXd::LinSpaced(leading_.rank(), 1, 2);
  std::vector<LeastSquares> levels(1);
  levels[0] = {Q, change, Eigen::VectorXd::Ones(leading_.rank())};
  for (std::vector<Selection> level : selections_) {
    for (Selection& row : level) row.target = 0;
    levels.push_back(Rows(level, n_));
  }
  Eigen::VectorXd y = y_;
  diagonal_.Correct(leading_, change.data(), false, y.data());
  EXPECT_LE((y - y_ - SolveLexicographically(n_, levels).y).norm(),
            10 * Tolerance());
}

TEST_P(RandomDiagonalLevelsTest, TieSufficesForTheNullities) {
  DiagonalLevels diagonal(n_, kMaxDiagonalLevels);
  for (size_t l = 0; l + 1 < selections_.size(); ++l) {
    diagonal.AddLevel();
    for (const Selection& row : selections_[l])
      diagonal.Add(row.variable, 1, 0);
  }
  diagonal.Finish(nullptr);
  diagonal.Tie(leading_);
  for (int l = 0; l < diagonal.num_levels(); ++l) {
    EXPECT_EQ(diagonal.Nullity(l), diagonal_.Nullity(l)) << l;
  }
}

// The rows span the same space, but are neither orthogonal nor of unit length.
TEST_P(RandomDiagonalLevelsTest, TieRowsFindsTheSameNullities) {
  const int rank = leading_.rank();
  Eigen::MatrixXd mix = Eigen::MatrixXd::Identity(rank, rank);
  for (int i = 0; i < rank; ++i) {
    for (int k = 0; k < i; ++k) mix(i, k) = 0.1 * ((i + 2 * k) % 5 - 2);
  }
  // Stored by rows, with three other numbers between two rows.
  const int stride = n_ + 3;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Constant(stride, rank, 100);
  rows.topRows(n_) = (mix * Basis()).transpose();
  DiagonalLevels diagonal(n_, kMaxDiagonalLevels);
  Fill(&diagonal);
  diagonal.TieRows(rows.data(), stride, rank);
  for (int l = 0; l < diagonal.num_levels(); ++l) {
    EXPECT_EQ(diagonal.Nullity(l), diagonal_.Nullity(l)) << l;
  }
}

TEST_P(RandomDiagonalLevelsTest, DoesNotDependOnTheLastSolve) {
  DiagonalLevels diagonal(n_, kMaxDiagonalLevels);
  LexicographicFactorization other(n_, n_, 1);
  Eigen::VectorXd y(n_);
  for (int i = 0; i < n_; ++i) {
    for (int j = 0; j < n_; ++j) other.row(i)[j] = i == j ? n_ : 1 + i + j % 3;
    Eigen::VectorXd::Map(other.row(i), n_).normalize();
    if (i % 2 == 1) continue;
    other.Truncate(0);
    for (int a = 0; a <= i; ++a) other.AddRow(a, 1);
    other.FactorLevel();
    diagonal.Clear();
    for (const int first : {0, 1}) {
      diagonal.AddLevel();
      for (int j = first; j < n_; j += 2) diagonal.Add(j, 1 + 7 * j % 5, 0);
    }
    diagonal.Finish(nullptr);
    diagonal.Solve(other, y.data());
  }
  diagonal.Clear();
  Fill(&diagonal);
  diagonal.Solve(leading_, y.data());
  EXPECT_EQ(y, y_);
  for (int l = 0; l < diagonal.num_levels(); ++l) {
    Eigen::VectorXd on_leading[2], left[2];
    for (int k = 0; k < 2; ++k) {
      on_leading[k].setZero(leading_.rank());
      left[k].setZero(n_);
      (k == 0 ? diagonal_ : diagonal)
          .Dual(leading_, l, on_leading[k].data(), left[k].data());
    }
    EXPECT_EQ(on_leading[0], on_leading[1]) << l;
    EXPECT_EQ(left[0], left[1]) << l;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomDiagonalLevelsTest,
                         testing::Range(0, kSeeds));

}  // namespace
}  // namespace poise
