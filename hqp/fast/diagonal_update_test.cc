// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <random>
#include <vector>

#include "poise/hqp/fast/diagonal_levels.h"
#include "poise/hqp/fast/lexicographic_factorization.h"
#include "poise/math/rank.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/stacked_rows.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr int kSeeds = 300, kChanges = 30;
// Kept factors may be those of a row space that differs by 1e-13, 450 eps.
constexpr double kScale = 1000;
constexpr int kMaxRows = 40, kMaxDiagonalLevels = 3;

// Rows of two leading levels, of which some are in use. The first level's rows of one
// variable fix it, if no row of that level depends on others.
class LeadingRows {
 public:
  LeadingRows(int n, int seed) : n_(n), random_(seed) {
    for (int i = 0; i < 2 * n; ++i) AddRandomRow();
  }

  const Eigen::VectorXd& row(int i) const { return rows_[i].r; }
  int size() const { return static_cast<int>(rows_.size()); }
  bool is_used(int i) const { return rows_[i].is_used; }
  void Toggle(int i) { rows_[i].is_used = !rows_[i].is_used; }
  int Below(int bound) {
    return static_cast<int>(random_() % static_cast<unsigned>(bound));
  }

  void Factor(LexicographicFactorization* leading) const {
    leading->Truncate(0);
    if (!FactorFirst(leading)) {
      leading->Truncate(0);
      for (const Row& row : rows_) {
        if (row.is_used && row.level == 0) Add(row, leading);
      }
      leading->FactorLevel();
    }
    for (const Row& row : rows_) {
      if (row.is_used && row.level == 1) Add(row, leading);
    }
    leading->FactorLevel();
  }

 private:
  struct Row {
    Eigen::VectorXd r;
    double target;
    int level;
    bool is_used;
  };
  double Entry() { return Below(2001) / 1000. - 1; }

  // A row of one variable, a row of any, or one that depends on others, exactly or
  // nearly.
  void AddRandomRow() {
    Row row = {Eigen::VectorXd::Zero(n_), Entry(), Below(2), Below(3) == 0};
    const int kind = rows_.empty() ? 1 : Below(5);
    if (kind == 0) {
      row.r[Below(n_)] = Below(2) == 0 ? 1 : -1;
    } else {
      for (int j = 0; j < n_; ++j) row.r[j] = Entry();
    }
    if (kind >= 3) {
      row.r *= kind == 3 ? 0 : 1e-8;
      for (int i = 0; i < 3; ++i) row.r += Entry() * rows_[Below(size())].r;
    }
    if (row.r.norm() == 0) row.r[0] = 1;
    row.r.normalize();
    rows_.push_back(row);
  }

  bool FactorFirst(LexicographicFactorization* leading) const {
    const auto variable = [](const Row& row) {
      int at;
      return row.r.cwiseAbs().maxCoeff(&at) == 1 ? at : -1;
    };
    for (const Row& row : rows_) {
      const int j = variable(row);
      if (!row.is_used || row.level != 0 || j < 0) continue;
      if (leading->variables().is_fixed(j)) return false;
      leading->AddFixedVariable(j, row.r[j], row.target, 1);
    }
    for (const Row& row : rows_) {
      if (row.is_used && row.level == 0 && variable(row) < 0) Add(row, leading);
    }
    return leading->num_rows() > 0 && leading->FactorMerged(1);
  }

  void Add(const Row& row, LexicographicFactorization* leading) const {
    const int a = leading->AddRow(row.target, 1);
    leading->SetRow(a, row.r.data(), 0, n_, 1);
  }

  int n_;
  std::mt19937 random_;
  std::vector<Row> rows_;
};

class DiagonalUpdateTest : public testing::TestWithParam<int> {
 protected:
  // Levels of random weights and targets; on a third of the seeds, some weights are
  // smaller by 1e-6, as those of contact forces.
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

  // Largest amplification of rounding: a level's equations are those columns of Q that
  // no earlier level determines, divided by the roots of the weights.
  double Condition(const DiagonalLevels& levels) const {
    const Eigen::MatrixXd Q = Basis(leading_, n_);
    double smallest = 1;
    if (Q.rows() == 0) return smallest;
    for (int level = 0; level < levels.num_levels(); ++level) {
      Eigen::MatrixXd columns = Q;
      for (int j = 0; j < n_; ++j) {
        if (levels.level(j) < level) columns.col(j).setZero();
      }
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(columns);
      for (const double sigma : svd.singularValues()) {
        if (sigma > kRankTolerance) smallest = std::min(smallest, sigma);
      }
    }
    // Weights from 1e-6 to 11 have roots with a ratio of 3300, and those from 1 to 11
    // of 3.3.
    return (GetParam() % 3 == 0 ? 3300 : 3.3) / smallest;
  }

  // Compares two solutions and their multipliers.
  void ExpectEqual(DiagonalLevels* kept, const Eigen::VectorXd& y,
                   DiagonalLevels* fresh, const Eigen::VectorXd& expected) {
    const double size = 10 + expected.lpNorm<Eigen::Infinity>();
    const double condition = Condition(*fresh);
    EXPECT_LE((y - expected).norm(),
              Rounding(kScale * size, n_, condition * condition));
    for (int level = 0; level < fresh->num_levels(); ++level) {
      EXPECT_EQ(kept->Nullity(level), fresh->Nullity(level)) << level;
      Eigen::VectorXd on_leading[2], left[2];
      double terms[2];
      for (int k = 0; k < 2; ++k) {
        on_leading[k].setZero(leading_.rank());
        left[k].setZero(n_);
        terms[k] =
            (k == 0 ? kept : fresh)
                ->Dual(leading_, level, on_leading[k].data(), left[k].data());
      }
      // The gradient of weights up to 11 has rounding of y. A gradient that is
      // rounding may be zero on one side only.
      const double tolerance =
          Rounding(kScale * (11 * size + std::max(terms[0], terms[1])), n_,
                   condition * condition);
      EXPECT_LE((on_leading[0] - on_leading[1]).norm(), tolerance) << level;
      EXPECT_LE((left[0] - left[1]).norm(), tolerance) << level;
    }
  }

  const int n_ = 4 + GetParam() % 14;
  LeadingRows rows_{n_, GetParam()};
  LexicographicFactorization leading_{n_, kMaxRows, 2};
};

// Rows are added and removed one by one. Kept factors give the solution of new ones.
TEST_P(DiagonalUpdateTest, AgreesWithNewFactors) {
  DiagonalLevels kept(n_, kMaxDiagonalLevels);
  DiagonalLevels fresh(n_, kMaxDiagonalLevels);
  Eigen::VectorXd y(n_), expected(n_);
  Fill(&kept);
  rows_.Factor(&leading_);
  kept.Solve(leading_, y.data());
  for (int change = 0; change < kChanges; ++change) {
    const int i = rows_.Below(rows_.size());
    rows_.Toggle(i);
    rows_.Factor(&leading_);
    kept.Update(leading_, rows_.row(i).data(), {0, n_}, 1, rows_.is_used(i));
    kept.Solve(leading_, y.data());
    Fill(&fresh);
    fresh.Solve(leading_, expected.data());
    ExpectEqual(&kept, y, &fresh, expected);
    if (HasFailure()) FAIL() << change;
  }
}

// Solve() finds out that the factors are those of other rows.
TEST_P(DiagonalUpdateTest, IsSafeIfTheRowIsWrong) {
  DiagonalLevels kept(n_, kMaxDiagonalLevels);
  DiagonalLevels fresh(n_, kMaxDiagonalLevels);
  Eigen::VectorXd y(n_), expected(n_);
  Fill(&kept);
  for (int change = 0; change < kChanges; ++change) {
    for (int i = 0; i < 3; ++i) rows_.Toggle(rows_.Below(rows_.size()));
    rows_.Factor(&leading_);
    const int i = rows_.Below(rows_.size());
    kept.Update(leading_, rows_.row(i).data(), {0, n_}, 1, change % 2 == 0);
    kept.Solve(leading_, y.data());
    Fill(&fresh);
    fresh.Solve(leading_, expected.data());
    ExpectEqual(&kept, y, &fresh, expected);
    if (HasFailure()) FAIL() << change;
  }
}

// 24 rows of 62 variables, as in a hard push: postures, and twelve forces of small
// weights. Six variables have no target.
class LargeDiagonalUpdateTest : public testing::Test {
 protected:
  static constexpr int kNumVariables = 62, kNumRows = 24;

  void Fill(DiagonalLevels* diagonal) const {
    diagonal->Clear();
    diagonal->AddLevel();
    for (int j = 6; j < kNumVariables; ++j) {
      diagonal->Add(j, j < 50 ? 1 + j % 5 : 1e-6, j % 7 - 3);
    }
    diagonal->Finish(nullptr);
  }
  void Factor(int rows) {
    leading_.Truncate(0);
    for (int i = 0; i < rows; ++i) {
      leading_.SetRow(leading_.AddRow(i, 1), row(i).data(), 0, kNumVariables,
                      1);
    }
    leading_.FactorLevel();
  }
  Eigen::VectorXd row(int i) const { return rows_.col(i).normalized(); }

  const Eigen::MatrixXd rows_ = [] {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    Eigen::MatrixXd rows(kNumVariables, kNumRows + 1);
    for (double& entry : rows.reshaped()) entry = normal(random);
    return rows;
  }();
  LexicographicFactorization leading_{kNumVariables, kNumRows + 1, 1};
  DiagonalLevels kept_{kNumVariables, 2};
};

TEST_F(LargeDiagonalUpdateTest, TakesLessThanHalfOfTheWorkOfNewFactors) {
  Eigen::VectorXd y(kNumVariables);
  Fill(&kept_);
  Factor(kNumRows);
  kept_.Solve(leading_, y.data());
  for (const bool is_added : {true, false}) {
    Factor(is_added ? kNumRows + 1 : kNumRows);
    DiagonalLevels fresh(kNumVariables, 2);
    Fill(&fresh);
    fresh.Solve(leading_, y.data());
    const std::int64_t before = kept_.multiply_adds();
    kept_.Update(leading_, row(kNumRows).data(), {0, kNumVariables}, 1,
                 is_added);
    kept_.Solve(leading_, y.data());
    EXPECT_LT(kept_.multiply_adds() - before, fresh.multiply_adds() / 2);
  }
}

TEST_F(LargeDiagonalUpdateTest, DoesNotAllocate) {
  Eigen::VectorXd y(kNumVariables);
  Fill(&kept_);
  Factor(kNumRows);
  kept_.Solve(leading_, y.data());
  Factor(kNumRows + 1);
  const Eigen::VectorXd added = row(kNumRows);
  const CountMalloc count;
  kept_.Update(leading_, added.data(), {0, kNumVariables}, 1, true);
  kept_.Solve(leading_, y.data());
  EXPECT_EQ(count.allocations(), 0);
}

// Without Update(), the factors are kept if the leading levels are the same.
TEST_F(LargeDiagonalUpdateTest, DropsFactors) {
  Eigen::VectorXd y(kNumVariables);
  Fill(&kept_);
  Factor(kNumRows);
  kept_.Solve(leading_, y.data());
  const std::int64_t first = kept_.multiply_adds();
  kept_.Solve(leading_, y.data());
  const std::int64_t second = kept_.multiply_adds();
  EXPECT_LT(second - first, first / 2);
  kept_.DropFactors();
  kept_.Solve(leading_, y.data());
  EXPECT_EQ(kept_.multiply_adds() - second, first);
}

INSTANTIATE_TEST_SUITE_P(Seeds, DiagonalUpdateTest, testing::Range(0, kSeeds));

}  // namespace
}  // namespace poise
