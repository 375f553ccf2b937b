// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "poise/hqp/fast/diagonal_levels.h"
#include "poise/hqp/fast/lexicographic_factorization.h"
#include "poise/math/rank.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/decompositions.h"
#include "poise/tests/util/stacked_rows.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr int kSeeds = 300, kChanges = 30;
constexpr int kMaxRows = 40, kMaxDiagonalLevels = 3;

// A row of one of two leading levels.
struct LeadingRow {
  Eigen::VectorXd r;
  double target;
  int level;
  bool is_used;

  // The variable of a row that has only one, or -1.
  int variable() const {
    int at;
    return r.cwiseAbs().maxCoeff(&at) == 1 ? at : -1;
  }
};

void Add(const LeadingRow& row, LexicographicFactorization* leading) {
  const int a = leading->AddRow(row.target, 1);
  leading->SetRow(a, row.r.data(), 0, static_cast<int>(row.r.size()), 1);
}

// Factors the first level as a merged one. Returns false if its rows depend on
// others.
bool FactorMerged(const std::vector<LeadingRow>& rows,
                  LexicographicFactorization* leading) {
  leading->Truncate(0);
  for (const LeadingRow& row : rows) {
    const int j = row.variable();
    if (!row.is_used || row.level != 0 || j < 0) continue;
    if (leading->variables().is_fixed(j)) return false;
    leading->AddFixedVariable(j, row.r[j], row.target, 1);
  }
  for (const LeadingRow& row : rows) {
    if (row.is_used && row.level == 0 && row.variable() < 0) Add(row, leading);
  }
  return leading->num_rows() > 0 && leading->FactorMerged(1);
}

// Factors both levels. Rows of the first level that have one variable fix it,
// if no row of that level depends on others.
void Factor(const std::vector<LeadingRow>& rows,
            LexicographicFactorization* leading) {
  const bool is_merged = FactorMerged(rows, leading);
  if (!is_merged) leading->Truncate(0);
  for (const int level : {0, 1}) {
    if (level == 0 && is_merged) continue;
    for (const LeadingRow& row : rows) {
      if (row.is_used && row.level == level) Add(row, leading);
    }
    leading->FactorLevel();
  }
}

// Returns random rows: rows of one variable, of all, and rows that depend on
// others, exactly or but for 1e-8, as rows of the two feet do. A third of them
// is in use.
std::vector<LeadingRow> MakeRows(int n, int count, std::mt19937* random) {
  const auto below = [&](int bound) {
    return static_cast<int>((*random)() % static_cast<unsigned>(bound));
  };
  const auto entry = [&] { return below(2001) / 1000. - 1; };
  std::vector<LeadingRow> rows;
  while (static_cast<int>(rows.size()) < count) {
    LeadingRow row = {Eigen::VectorXd::Zero(n), entry(), below(2),
                      below(3) == 0};
    const int kind = rows.empty() ? 1 : below(5);
    if (kind == 0) {
      row.r[below(n)] = below(2) == 0 ? 1 : -1;
    } else {
      for (double& number : row.r) number = entry();
    }
    if (kind >= 3) {
      row.r *= kind == 3 ? 0 : 1e-8;
      for (int i = 0; i < 3; ++i) {
        row.r += entry() * rows[below(static_cast<int>(rows.size()))].r;
      }
    }
    if (row.r.norm() == 0) row.r[0] = 1;
    row.r.normalize();
    rows.push_back(row);
  }
  return rows;
}

// Largest amplification of rounding: a level's equations are those columns of Q
// that no earlier level determines, divided by the roots of the weights.
// `ratio` is the largest ratio of two roots.
double Condition(const LexicographicFactorization& leading, int n,
                 const DiagonalLevels& levels, double ratio) {
  const Eigen::MatrixXd Q = Basis(leading, n);
  double smallest = 1;
  if (Q.rows() == 0) return ratio;
  for (int level = 0; level < levels.num_levels(); ++level) {
    Eigen::MatrixXd columns = Q;
    for (int j = 0; j < n; ++j) {
      if (levels.level(j) < level) columns.col(j).setZero();
    }
    const JacobiSvd svd(columns);
    for (const double sigma : svd.sigma) {
      if (sigma > kRankTolerance) smallest = std::min(smallest, sigma);
    }
  }
  return ratio / smallest;
}

// Compares two solutions and their multipliers, for weights up to 100.
void ExpectEqual(const LexicographicFactorization& leading, double ratio,
                 DiagonalLevels* kept, const Eigen::VectorXd& y,
                 DiagonalLevels* fresh, const Eigen::VectorXd& expected) {
  const auto n = static_cast<int>(y.size());
  const double size = 10 + expected.lpNorm<Eigen::Infinity>();
  const double condition = Condition(leading, n, *fresh, ratio);
  // Ten: the largest error that was seen is seven times the rounding. The
  // factors may be those of a row space that differs by 1e-13.
  EXPECT_LE((y - expected).norm(), Rounding(10 * size, n, condition));
  for (int level = 0; level < fresh->num_levels(); ++level) {
    EXPECT_EQ(kept->Nullity(level), fresh->Nullity(level)) << level;
    Eigen::VectorXd on_leading[2], left[2];
    double terms[2];
    for (int k = 0; k < 2; ++k) {
      on_leading[k].setZero(leading.rank());
      left[k].setZero(n);
      terms[k] =
          (k == 0 ? kept : fresh)
              ->Dual(leading, level, on_leading[k].data(), left[k].data());
    }
    // The gradient has rounding of y. A gradient that is rounding may be zero
    // on one side only.
    const double tolerance = Rounding(
        10 * (100 * size + std::max(terms[0], terms[1])), n, condition);
    EXPECT_LE((on_leading[0] - on_leading[1]).norm(), tolerance) << level;
    EXPECT_LE((left[0] - left[1]).norm(), tolerance) << level;
  }
}

class DiagonalUpdateTest : public testing::TestWithParam<int> {
 protected:
  // Levels of random weights and targets; on a third of the seeds, some weights
  // are smaller by 1e-6, as those of contact forces.
  void Fill(DiagonalLevels* diagonal) const {
    std::mt19937 random(GetParam());
    const auto below = [&](int bound) {
      return static_cast<int>(random() % static_cast<unsigned>(bound));
    };
    diagonal->Clear();
    for (int level = below(kMaxDiagonalLevels + 1); level > 0; --level) {
      diagonal->AddLevel();
      const bool has_usual = below(2) == 0;
      for (int i = 1 + below(n_); i > 0; --i) {
        const double weight = has_usual && below(4) > 0 ? 2.5 : 1 + below(10);
        const bool is_small = GetParam() % 3 == 0 && below(3) == 0;
        diagonal->Add(below(n_), weight * (is_small ? 1e-6 : 1),
                      below(21) - 10);
      }
    }
    diagonal->Finish(nullptr);
  }

  int Below(int bound) {
    return static_cast<int>(random_() % static_cast<unsigned>(bound));
  }

  // Solves with kept and with new factors, and compares.
  void ExpectNewFactors(DiagonalLevels* kept) {
    DiagonalLevels fresh(n_, kMaxDiagonalLevels);
    Eigen::VectorXd y(n_), expected(n_);
    kept->Solve(leading_, y.data());
    Fill(&fresh);
    fresh.Solve(leading_, expected.data());
    // Add() adds up the weights of a variable, so that they range from 1 to 100
    // or from 1e-6 to 100.
    ExpectEqual(leading_, GetParam() % 3 == 0 ? 1e4 : 10, kept, y, &fresh,
                expected);
  }

  const int n_ = 4 + GetParam() % 14;
  std::mt19937 random_{static_cast<unsigned>(GetParam())};
  std::vector<LeadingRow> rows_ = MakeRows(n_, 2 * n_, &random_);
  LexicographicFactorization leading_{n_, kMaxRows, 2};
};

// Rows are added and removed one by one.
TEST_P(DiagonalUpdateTest, AgreesWithNewFactors) {
  DiagonalLevels kept(n_, kMaxDiagonalLevels);
  Fill(&kept);
  Factor(rows_, &leading_);
  ExpectNewFactors(&kept);
  for (int change = 0; change < kChanges; ++change) {
    LeadingRow& row = rows_[Below(2 * n_)];
    row.is_used = !row.is_used;
    Factor(rows_, &leading_);
    ExpectNewFactors(&kept);
    if (HasFailure()) FAIL() << change;
  }
}

// Some of the changes are updates, and others need new factors.
TEST_P(DiagonalUpdateTest, AgreesWithNewFactorsAfterSeveralChanges) {
  DiagonalLevels kept(n_, kMaxDiagonalLevels);
  Fill(&kept);
  for (int change = 0; change < kChanges; ++change) {
    for (int i = Below(6); i >= 0; --i) {
      LeadingRow& row = rows_[Below(2 * n_)];
      row.is_used = !row.is_used;
    }
    Factor(rows_, &leading_);
    ExpectNewFactors(&kept);
    if (HasFailure()) FAIL() << change;
  }
}

// 24 rows of 62 variables, as in a hard push: postures, and twelve forces of
// small weights. Six variables, those of the base, have no target.
class LargeDiagonalUpdateTest : public testing::Test {
 protected:
  static constexpr int kNumVariables = 62, kNumRows = 24;

  void Fill(DiagonalLevels* diagonal) const {
    diagonal->Clear();
    diagonal->AddLevel();
    for (int j = 6; j < kNumVariables; ++j) {
      // The first level of two leaves out six variables more.
      if (num_levels_ == 2 && j < 12) continue;
      const double weight = j % 3 == 0 ? 2 : 1 + j % 5;
      diagonal->Add(j, j < 50 ? weight : 1e-6, j % 7 - 3);
    }
    if (num_levels_ == 2) {
      diagonal->AddLevel();
      for (int j = 6; j < 12; ++j) diagonal->Add(j, 1 + j % 3, 1);
    }
    diagonal->Finish(nullptr);
  }
  LeadingRow Random(int level = 0) {
    LeadingRow row = {Eigen::VectorXd(kNumVariables), 1, level, true};
    for (double& entry : row.r) entry = normal_(random_);
    row.r.normalize();
    return row;
  }
  // A row that depends on four others, but for a part of this length.
  LeadingRow NearlyDependent(double part, int level = 0) {
    LeadingRow row = Random(level);
    row.r *= part;
    for (int i = 0; i < 4; ++i) row.r += (1 - 0.4 * i) * rows_[i].r;
    row.r.normalize();
    return row;
  }
  // Adds rows and removes them again, or the other way round. Solve() then
  // agrees with new factors. If one row has changed or rows were added, it
  // takes less work: the factors have been updated.
  void ExpectUpdate(int first, int count = 1) {
    Eigen::VectorXd y(kNumVariables), expected(kNumVariables);
    for (int twice = 0; twice < 2; ++twice) {
      Fill(&kept_);
      Factor(rows_, &leading_);
      kept_.Solve(leading_, y.data());
      for (int i = first; i < first + count; ++i) {
        rows_[i].is_used = !rows_[i].is_used;
      }
      Factor(rows_, &leading_);
      DiagonalLevels fresh(kNumVariables, 3);
      Fill(&fresh);
      fresh.Solve(leading_, expected.data());
      const std::int64_t before = kept_.multiply_adds();
      kept_.Solve(leading_, y.data());
      if (count == 1 || rows_[first].is_used) {
        EXPECT_LT(kept_.multiply_adds() - before, fresh.multiply_adds())
            << rows_[first].is_used;
      }
      // The weights are 1e-6 to 5.
      ExpectEqual(leading_, 2300, &kept_, y, &fresh, expected);
    }
  }

  int num_levels_ = 1;  // Without that of Finish().
  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
  std::vector<LeadingRow> rows_;
  LexicographicFactorization leading_{kNumVariables, 2 * kNumVariables, 2};
  DiagonalLevels kept_{kNumVariables, 3};
};

TEST_F(LargeDiagonalUpdateTest, FollowsAnIndependentRow) {
  for (int i = 0; i < kNumRows; ++i) rows_.push_back(Random(i % 2));
  ExpectUpdate(0);
  ExpectUpdate(5);
}

TEST_F(LargeDiagonalUpdateTest, FollowsARowThatNearlyDependsOnOthers) {
  for (int i = 0; i < kNumRows; ++i) rows_.push_back(Random());
  // Rows of the two feet are independent by 1e-8; the other part lies between.
  for (const double part : {1e-4, 1e-8}) {
    rows_.push_back(NearlyDependent(part));
    ExpectUpdate(kNumRows);
    rows_.pop_back();
  }
}

// The first level's new row replaces one of the second level, which gets
// deficient.
TEST_F(LargeDiagonalUpdateTest, FollowsARowThatReplacesAnother) {
  for (int i = 0; i < kNumRows; ++i) rows_.push_back(Random());
  rows_.push_back(NearlyDependent(1e-8, 1));
  rows_.push_back(rows_.back());
  rows_.back().level = 0;
  // A remainder of 1e-12 counts as rounding: the rows are taken as dependent.
  // But the remainder of the new row has another direction by a ten-thousandth.
  rows_.back().r += 1e-12 * Random().r;
  rows_.back().is_used = false;
  ExpectUpdate(kNumRows + 1);
}

// The row space stays the same.
TEST_F(LargeDiagonalUpdateTest, FollowsADependentRow) {
  for (int i = 0; i < kNumRows; ++i) rows_.push_back(Random());
  rows_.push_back(NearlyDependent(0, 1));
  ExpectUpdate(kNumRows);
}

TEST_F(LargeDiagonalUpdateTest, FollowsAVariableThatIsFixedAndReleased) {
  for (int i = 0; i < kNumRows; ++i) rows_.push_back(Random());
  // Variables of the usual weight, of another one, and a force.
  for (const int j : {9, 11, 52}) {
    LeadingRow row = Random();
    row.r = Eigen::VectorXd::Unit(kNumVariables, j);
    rows_.push_back(row);
    ExpectUpdate(static_cast<int>(rows_.size()) - 1);
  }
}

TEST_F(LargeDiagonalUpdateTest, FollowsSeveralRowsThatAreAdded) {
  for (int i = 0; i < kNumRows; ++i) rows_.push_back(Random(i % 2));
  for (const int count : {2, 3}) ExpectUpdate(4, count);
}

TEST_F(LargeDiagonalUpdateTest, FollowsSeveralVariablesThatAreFixed) {
  for (int i = 0; i < kNumRows; ++i) rows_.push_back(Random());
  for (const int j : {9, 11, 30, 31}) {
    LeadingRow row = Random();
    row.r = Eigen::VectorXd::Unit(kNumVariables, j);
    rows_.push_back(row);
  }
  for (const int count : {2, 3, 4}) ExpectUpdate(kNumRows, count);
}

// Variables are fixed one after the other, until the rows leave no freedom, and
// then released, one by one. An update keeps the columns of all fixed
// variables, so that new factors take less work from some point on. The
// estimate that decides is not exact, and a failed update is in vain: a quarter
// more.
TEST_F(LargeDiagonalUpdateTest, NeverTakesMuchMoreWorkThanNewFactors) {
  for (int i = 0; i < kNumRows; ++i) rows_.push_back(Random());
  for (int j = 6; j < 6 + kNumVariables - kNumRows; ++j) {
    rows_.push_back({Eigen::VectorXd::Unit(kNumVariables, j), 1, 0, false});
  }
  std::int64_t work, new_work;
  // Solves with the first `fixed` variables fixed.
  const auto solve = [&](int fixed) {
    for (size_t i = kNumRows; i < rows_.size(); ++i) {
      rows_[i].is_used = static_cast<int>(i) < kNumRows + fixed;
    }
    Factor(rows_, &leading_);
    Eigen::VectorXd y(kNumVariables), expected(kNumVariables);
    DiagonalLevels fresh(kNumVariables, 3);
    Fill(&fresh);
    fresh.Solve(leading_, expected.data());
    const std::int64_t before = kept_.multiply_adds();
    kept_.Solve(leading_, y.data());
    const std::int64_t added = kept_.multiply_adds() - before;
    EXPECT_LE(added, 1.25 * static_cast<double>(fresh.multiply_adds()))
        << fixed;
    work += added;
    new_work += fresh.multiply_adds();
    ExpectEqual(leading_, 2300, &kept_, y, &fresh, expected);
  };
  constexpr int kMost = kNumVariables - kNumRows;
  for (const int step : {1, 2, 4}) {
    SCOPED_TRACE(step);
    Fill(&kept_);
    work = new_work = 0;
    for (int fixed = 0; fixed <= kMost; fixed += step) solve(fixed);
    EXPECT_LT(work, new_work);
  }
  SCOPED_TRACE("released");
  work = new_work = 0;
  for (int fixed = kMost; fixed >= 0; --fixed) solve(fixed);
  EXPECT_LT(work, new_work);
}

TEST_F(LargeDiagonalUpdateTest, FollowsWithSeveralLaterLevels) {
  num_levels_ = 2;
  for (int i = 0; i < kNumRows; ++i) rows_.push_back(Random());
  ExpectUpdate(7);
}

// The second row space has the difference of two vectors of the first one. A
// sum of its rows with equal factors does not change, but for the sign, if the
// two are exchanged.
TEST(DiagonalUpdate, SeesThatTwoDirectionsAreExchanged) {
  LexicographicFactorization leading(3, 2, 2);
  DiagonalLevels kept(3, 1), fresh(3, 1);
  for (DiagonalLevels* levels : {&kept, &fresh}) {
    levels->AddLevel();
    for (int j = 0; j < 3; ++j) levels->Add(j, 1, 4 + j);
    levels->Finish(nullptr);
  }
  Eigen::VectorXd y(3), expected(3);
  const auto factor = [&](const Eigen::Vector3d& first,
                          const Eigen::Vector3d& second) {
    Factor({{first, 1, 0, true}, {second, 2, 0, true}}, &leading);
  };
  factor(Eigen::Vector3d::UnitX(), Eigen::Vector3d(0, 1, 1e-9).normalized());
  kept.Solve(leading, y.data());
  for (const double sign : {1, -1}) {
    factor(Eigen::Vector3d(1, sign, 0).normalized(), Eigen::Vector3d::UnitZ());
    kept.Solve(leading, y.data());
    fresh.Tie(leading);  // Discards the factors.
    fresh.Solve(leading, expected.data());
    EXPECT_LE((y - expected).norm(), Rounding(10 * 6, 3)) << sign;
  }
}

// Only the first row has the variable of the last level. Without this row, the
// last level has no row.
TEST(DiagonalUpdate, FactorsAgainIfALaterLevelLosesItsRow) {
  LexicographicFactorization leading(3, 2, 2);
  DiagonalLevels kept(3, 1), fresh(3, 1);
  for (DiagonalLevels* levels : {&kept, &fresh}) {
    levels->AddLevel();
    levels->Add(1, 2, 4);
    levels->Add(2, 3, 5);
    levels->Finish(nullptr);
  }
  std::vector<LeadingRow> rows = {
      {Eigen::Vector3d(1, 1, 0).normalized(), 1, 0, true},
      {Eigen::Vector3d(0, 1, -1).normalized(), 2, 0, true}};
  Eigen::VectorXd y(3), expected(3);
  Factor(rows, &leading);
  kept.Solve(leading, y.data());
  EXPECT_EQ(kept.Nullity(0), 0);
  rows[0].is_used = false;
  Factor(rows, &leading);
  kept.Solve(leading, y.data());
  fresh.Solve(leading, expected.data());
  EXPECT_EQ(kept.Nullity(0), 1);
  EXPECT_EQ(y, expected);
}

TEST_F(LargeDiagonalUpdateTest, DoesNotAllocate) {
  Eigen::VectorXd y(kNumVariables);
  for (int i = 0; i < kNumRows; ++i) rows_.push_back(Random());
  rows_.push_back(Random());
  rows_.back().r = Eigen::VectorXd::Unit(kNumVariables, 9);
  Fill(&kept_);
  Factor(rows_, &leading_);
  kept_.Solve(leading_, y.data());
  // A row, a variable that is released, and two rows.
  for (const std::vector<int>& changed :
       std::vector<std::vector<int>>{{0}, {0}, {kNumRows}, {1, 2}}) {
    for (const int i : changed) rows_[i].is_used = !rows_[i].is_used;
    Factor(rows_, &leading_);
    const CountMalloc count;
    kept_.Solve(leading_, y.data());
    EXPECT_EQ(count.allocations(), 0);
  }
}

// Each change of the diagonal levels, and Tie(), discard the factors.
TEST_F(LargeDiagonalUpdateTest, KeepsFactorsOfTheSameLevelsOnly) {
  Eigen::VectorXd y(kNumVariables);
  for (int i = 0; i < kNumRows; ++i) rows_.push_back(Random());
  const auto work = [&] {
    const std::int64_t before = kept_.multiply_adds();
    kept_.Solve(leading_, y.data());
    return kept_.multiply_adds() - before;
  };
  Fill(&kept_);
  Factor(rows_, &leading_);
  const std::int64_t first = work();
  EXPECT_LT(work(), first);
  kept_.Tie(leading_);
  EXPECT_EQ(work(), first);
  Fill(&kept_);
  EXPECT_EQ(work(), first);
}

INSTANTIATE_TEST_SUITE_P(Seeds, DiagonalUpdateTest, testing::Range(0, kSeeds));

}  // namespace
}  // namespace poise
