// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/working_set_problem.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include "poise/hqp/fast/tolerances.h"
#include "poise/tests/util/decompositions.h"
#include "poise/tests/util/lexicographic.h"
#include "poise/tests/util/random_hierarchy.h"
#include "poise/tests/util/stacked_rows.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr int kSeeds = 150;
constexpr int kMaxRows = 4 * 8 + 8;  // Rows of Draw() and of the norm of y.
constexpr double kLargest = 30;      // Largest number of Draw(), and of y.

using Sides = std::vector<std::vector<Side>>;

HierarchyCase Draw(int seed) {
  RandomHierarchyOptions options;
  options.max_variables = 8;
  options.max_levels = 4;
  options.max_equalities = 4;
  options.max_inequalities = 4;
  options.scaled = 0;
  return MakeRandomHierarchy(seed, options);
}

// A hierarchy with a working set.
class RandomWorkingSetProblemTest : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    int failed_level = 5;
    ASSERT_EQ(problem_.Read(hierarchy_, &failed_level), Status::kOptimal);
    EXPECT_EQ(failed_level, -1);
  }
  // Returns a working set of finite bounds, another one for each salt.
  Sides MakeSides(int salt) const {
    Sides sides;
    for (int k = 0; k < num_levels_; ++k) {
      sides.emplace_back(drawn_.capacity[k].inequalities, Side::kNone);
      for (int i = 0; i < hierarchy_.num_inequalities(k); ++i) {
        const int choice = (3 * k + i * (1 + salt) + salt) % 4;
        if (choice < 2 && std::isfinite(hierarchy_.upper(k)[i])) {
          sides[k][i] = Side::kUpper;
        } else if (choice < 3 && std::isfinite(hierarchy_.lower(k)[i])) {
          sides[k][i] = Side::kLower;
        }
      }
    }
    return sides;
  }
  double Bound(int k, int i, Side side) const {
    return side == Side::kUpper ? hierarchy_.upper(k)[i]
                                : hierarchy_.lower(k)[i];
  }
  // Returns the first levels with the rows in the working set, and a last level
  // with the target `center`.
  std::vector<LeastSquares> Levels(const Sides& sides, int num_levels,
                                   const Eigen::VectorXd& center) const;
  Eigen::VectorXd Original(const WorkingSetProblem::Row& row) const {
    if (row.is_inequality) return hierarchy_.C(row.level).row(row.index);
    return hierarchy_.B(row.level).row(row.index);
  }
  Eigen::VectorXd y() const {
    return Eigen::VectorXd::Map(problem_.y().data(), n_);
  }
  // Returns the number of leading levels. In all levels after them, each row
  // has at most one variable.
  int NumLeading(int num_levels) const {
    int leading = num_levels;
    while (leading > 0 && hierarchy_.num_inequalities(leading - 1) == 0) {
      const auto is_entry = hierarchy_.B(leading - 1).array() != 0;
      if (is_entry.rows() > 0 &&
          is_entry.cast<int>().rowwise().sum().maxCoeff() > 1) {
        break;
      }
      --leading;
    }
    return leading;
  }

  // Compares y and the rows with those of the optimum. The tolerance is
  // rounding times the squared condition of the levels.
  void Check(const Sides& sides, int num_levels, const Eigen::VectorXd& center);
  // Expects that the rows of the leading levels are those of the hierarchy,
  // each one once.
  void CheckRows(const Sides& sides, const Eigen::VectorXd& optimum);
  // Expects that the multipliers of each level cancel its gradient. With `own`,
  // they include those on the rows of the level itself.
  void CheckMultipliers(bool own);
  // Expects that the size of the multipliers is the largest of the gradient's
  // terms and of the multipliers.
  void CheckSize(int level);

  const HierarchyCase drawn_ = Draw(GetParam());
  const Hierarchy& hierarchy_ = drawn_.hierarchy;
  const int n_ = hierarchy_.num_variables();
  const int num_levels_ = hierarchy_.num_levels();
  const Eigen::VectorXd zero_ = Eigen::VectorXd::Zero(n_);
  WorkingSetProblem problem_{n_, drawn_.capacity};
  double tolerance_ = 0;
};

std::vector<LeastSquares> RandomWorkingSetProblemTest::Levels(
    const Sides& sides, int num_levels, const Eigen::VectorXd& center) const {
  std::vector<LeastSquares> levels;
  for (int k = 0; k < num_levels; ++k) {
    LeastSquares level;
    const int most = hierarchy_.num_equalities(k) + 4;
    level.A.resize(most, n_);
    level.b.resize(most);
    level.weight.resize(most);
    int count = 0;
    for (int i = 0; i < hierarchy_.num_equalities(k); ++i) {
      level.A.row(count) = hierarchy_.B(k).row(i);
      level.b[count] = -hierarchy_.b(k)[i];
      level.weight[count++] = hierarchy_.weight(k)[i];
    }
    for (int i = 0; i < hierarchy_.num_inequalities(k); ++i) {
      if (sides[k][i] == Side::kNone) continue;
      level.A.row(count) = hierarchy_.C(k).row(i);
      level.b[count] = Bound(k, i, sides[k][i]);
      level.weight[count++] = 1;
    }
    levels.push_back({level.A.topRows(count), level.b.head(count),
                      level.weight.head(count)});
  }
  levels.push_back(
      {Eigen::MatrixXd::Identity(n_, n_), center, Eigen::VectorXd::Ones(n_)});
  return levels;
}

void RandomWorkingSetProblemTest::Check(const Sides& sides, int num_levels,
                                        const Eigen::VectorXd& center) {
  const std::vector<LeastSquares> levels = Levels(sides, num_levels, center);
  const LexicographicOptimum optimum = SolveLexicographically(n_, levels);
  tolerance_ =
      Rounding(kLargest, kMaxRows, optimum.condition * optimum.condition);
  EXPECT_LE((y() - optimum.y).norm(), tolerance_);
  ASSERT_EQ(problem_.num_levels(), num_levels);
  ASSERT_EQ(problem_.num_leading(), NumLeading(num_levels));
  int count = 0;
  for (int k = 0; k < problem_.num_leading(); ++k) {
    for (int i = 0; i < levels[k].A.rows(); ++i) {
      count += levels[k].weight[i] > 0 && levels[k].A.row(i).norm() > 0;
    }
  }
  ASSERT_EQ(problem_.leading().num_rows(), count);
  CheckRows(sides, optimum.y);
}

void RandomWorkingSetProblemTest::CheckRows(const Sides& sides,
                                            const Eigen::VectorXd& optimum) {
  for (int a = 0; a < problem_.leading().num_rows(); ++a) {
    const WorkingSetProblem::Row& row = problem_.row(a);
    const Eigen::VectorXd original = Original(row);
    const double weight =
        row.is_inequality ? 1 : hierarchy_.weight(row.level)[row.index];
    EXPECT_NEAR(row.norm, original.norm(), Rounding(row.norm, n_));
    EXPECT_NEAR(problem_.leading().weight(a), weight * original.squaredNorm(),
                Rounding(problem_.leading().weight(a), n_));
    EXPECT_EQ(row.bound,
              row.is_inequality
                  ? Bound(row.level, row.index, sides[row.level][row.index])
                  : -hierarchy_.b(row.level)[row.index]);
    EXPECT_NEAR(problem_.leading().residual(a),
                (original.dot(optimum) - row.bound) / row.norm, tolerance_)
        << row.level << ", " << row.index;
    for (int b = 0; b < a; ++b) {  // Each row occurs once.
      const WorkingSetProblem::Row& other = problem_.row(b);
      EXPECT_FALSE(other.level == row.level && other.index == row.index &&
                   other.is_inequality == row.is_inequality);
    }
  }
}

void RandomWorkingSetProblemTest::CheckMultipliers(bool own) {
  const int rows = problem_.leading().num_rows();
  for (int k = 0; k <= problem_.num_levels(); ++k) {
    SCOPED_TRACE(k);
    const WorkingSetProblem::Multipliers& of = problem_.multipliers(k);
    const bool is_leading = k < problem_.num_leading();
    const bool has_own =
        own && is_leading && (of.any || problem_.leading().is_deficient(k));
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n_);
    double size = 1;
    for (int a = 0; a < rows; ++a) {
      const WorkingSetProblem::Row& row = problem_.row(a);
      const Eigen::VectorXd unit = Original(row) / row.norm;
      const double force =
          problem_.leading().weight(a) * problem_.leading().residual(a);
      const bool is_own = is_leading && a >= problem_.leading().first_row(k) &&
                          a < problem_.leading().end_row(k);
      if (is_own) {
        size = std::max(size, problem_.leading().weight(a) * kLargest);
        if (has_own) {
          EXPECT_NEAR(of.nu[a], force, tolerance_ * size);
          sum += of.nu[a] * unit;
        } else {
          sum += force * unit;
        }
      }
      const bool is_above = !is_leading || a < problem_.leading().first_row(k);
      if (is_above && of.any) {
        sum += of.nu[a] * unit;
        size = std::max(size, std::abs(of.nu[a]));
      }
    }
    if (!is_leading) {
      const std::vector<double> none(n_);
      std::vector<double> gradient(n_);
      problem_.diagonal().AddGradient(
          k - problem_.num_leading(), problem_.y().data(),
          of.any ? of.left.data() : none.data(), gradient.data());
      sum += Eigen::VectorXd::Map(gradient.data(), n_);
    }
    EXPECT_LE(sum.norm(), 100 * tolerance_ * size);
    if (of.any && !own) CheckSize(k);
  }
}

void RandomWorkingSetProblemTest::CheckSize(int level) {
  const WorkingSetProblem::Multipliers& of = problem_.multipliers(level);
  const bool is_leading = level < problem_.num_leading();
  const int rows = problem_.leading().num_rows();
  std::vector<double> gradient(n_ + rows), left(n_);
  LexicographicFactorization leading = problem_.leading();
  double largest =
      is_leading ? leading.Gradient(level, gradient.data())
                 : problem_.diagonal().Dual(problem_.leading(),
                                            level - problem_.num_leading(),
                                            gradient.data(), left.data());
  for (int a = 0; a < rows; ++a) {
    if (is_leading && a >= problem_.leading().first_row(level)) continue;
    largest = std::max(largest, std::abs(of.nu[a]));
  }
  EXPECT_EQ(of.size, largest);
}

TEST_P(RandomWorkingSetProblemTest, AgreesWithSingularValues) {
  for (int levels = 0; levels <= num_levels_; ++levels) {
    SCOPED_TRACE(levels);
    const Sides sides = MakeSides(levels);
    problem_.Plan(hierarchy_, levels);
    problem_.Solve(hierarchy_, sides);
    Check(sides, levels, zero_);
    problem_.FindMultipliers(levels + 1);
    CheckMultipliers(false);
    problem_.Refine(hierarchy_);
    Check(sides, levels, zero_);
    // Refinement moves y by rounding, so that the multipliers from before will
    // do.
    problem_.RefineMultipliers(hierarchy_);
    CheckMultipliers(true);
    problem_.FindMultipliers(levels + 1);
    problem_.RefineMultipliers(hierarchy_);
    CheckMultipliers(true);
  }
}

// Rows are added, removed and change sides, as in a search.
TEST_P(RandomWorkingSetProblemTest, UpdatesAreAsExactAsANewFactorisation) {
  problem_.Plan(hierarchy_, num_levels_);
  for (int salt = 0; salt < 6; ++salt) {
    SCOPED_TRACE(salt);
    const Sides sides = MakeSides(salt);
    problem_.Solve(hierarchy_, sides);
    Check(sides, num_levels_, zero_);
  }
  problem_.Refine(hierarchy_);
  Check(MakeSides(5), num_levels_, zero_);
}

// With a budget without multiply-adds, no level that needs any is solved, and
// the next solution is as if there had been no interruption.
TEST_P(RandomWorkingSetProblemTest, SolvesAgainAfterAnInterruption) {
  const std::function<double()> no_clock;
  problem_.Plan(hierarchy_, num_levels_);
  problem_.Solve(hierarchy_, MakeSides(0));
  const int num_leading = problem_.num_leading();
  for (int salt = 1; salt < 6; ++salt) {
    SCOPED_TRACE(salt);
    const Sides sides = MakeSides(salt);
    Budget budget({9, ModelledSeconds(problem_.work()) / Budget::kMost},
                  &no_clock);
    for (int i = 0; i <= Budget::kAlways; ++i) ASSERT_TRUE(budget.Take({}));
    const std::int64_t before = problem_.leading().multiply_adds();
    const bool is_solved = problem_.SolveWithin(hierarchy_, sides, &budget);
    EXPECT_EQ(budget.is_spent(), !is_solved);
    EXPECT_EQ(problem_.leading().num_levels() == num_leading, is_solved);
    if (!is_solved) {
      EXPECT_GT(problem_.leading().multiply_adds(), before);
      problem_.Solve(hierarchy_, sides);
    }
    Check(sides, num_levels_, zero_);
  }
}

TEST_P(RandomWorkingSetProblemTest, CountsTheRowsThatAreSolvedNext) {
  problem_.Plan(hierarchy_, num_levels_);
  problem_.Solve(hierarchy_, MakeSides(0));
  Work expected = problem_.work();
  expected.num_active = 0;
  const Sides sides = MakeSides(1);
  for (const std::vector<Side>& level : sides) {
    for (const Side side : level) expected.num_active += side != Side::kNone;
  }
  const Work found = problem_.WorkWith(hierarchy_, sides);
  EXPECT_EQ(found.num_active, expected.num_active);
  EXPECT_EQ(ModelledSeconds(found), ModelledSeconds(expected));
}

// The rows of one more level go to their other bounds each time.
TEST_P(RandomWorkingSetProblemTest, SolvesAgainIfRowsGoToTheirOtherBounds) {
  Sides sides = MakeSides(2);
  problem_.Plan(hierarchy_, num_levels_);
  problem_.Solve(hierarchy_, sides);
  for (int k = 0; k < num_levels_; ++k) {
    for (size_t i = 0; i < sides[k].size(); ++i) {
      if (sides[k][i] == Side::kNone) continue;
      const Side other =
          sides[k][i] == Side::kUpper ? Side::kLower : Side::kUpper;
      if (std::isfinite(Bound(k, static_cast<int>(i), other)))
        sides[k][i] = other;
    }
    SCOPED_TRACE(k);
    problem_.Solve(hierarchy_, sides);
    Check(sides, num_levels_, zero_);
  }
  problem_.FindMultipliers(num_levels_ + 1);
  CheckMultipliers(false);
  problem_.Refine(hierarchy_);
  Check(sides, num_levels_, zero_);
}

TEST_P(RandomWorkingSetProblemTest, StaysCloseToACenter) {
  const Eigen::VectorXd center = Eigen::VectorXd::LinSpaced(n_, 1, 3);
  for (int levels = 0; levels <= num_levels_; ++levels) {
    SCOPED_TRACE(levels);
    problem_.Plan(hierarchy_, levels, center.data());
    problem_.Solve(hierarchy_, MakeSides(1));
    Check(MakeSides(1), levels, center);
  }
}

// From a y that differs from the optimum in every direction, refinement makes
// the smallest step that meets the rows.
TEST_P(RandomWorkingSetProblemTest, RefinesAnotherYToMeetTheRows) {
  const Sides sides = MakeSides(2);
  const int num_leading = NumLeading(num_levels_);
  problem_.Plan(hierarchy_, num_levels_);
  problem_.Solve(hierarchy_, sides);
  Check(sides, num_levels_, zero_);
  const Eigen::VectorXd optimum = y();
  std::vector<double> other = problem_.y();
  for (int j = 0; j < n_; ++j) other[j] += 1 + j % 2;
  const Eigen::VectorXd start = Eigen::VectorXd::Map(other.data(), n_);
  problem_.RefineFrom(hierarchy_, other);
  // The weights of the diagonal levels determine the step, not their targets.
  std::vector<LeastSquares> levels = Levels(sides, num_levels_, start);
  for (int k = num_leading; k < num_levels_; ++k)
    levels[k].b = levels[k].A * start;
  const LexicographicOptimum nearest = SolveLexicographically(n_, levels);
  EXPECT_LE(
      (y() - nearest.y).norm(),
      Rounding(kLargest, kMaxRows, nearest.condition * nearest.condition));

  problem_.SetSolution(hierarchy_, other);
  EXPECT_EQ(problem_.y(), other);
  // Residuals are those of the level's optimum among the optima above.
  for (int k = 0; k < num_leading; ++k) {
    std::vector<LeastSquares> held = Levels(sides, num_levels_, start);
    held.resize(k + 1);
    for (int above = 0; above < k; ++above)
      held[above].b = held[above].A * start;
    const LexicographicOptimum best = SolveLexicographically(n_, held);
    const double tolerance =
        Rounding(kLargest, kMaxRows, best.condition * best.condition);
    for (int a = problem_.leading().first_row(k);
         a < problem_.leading().end_row(k); ++a) {
      const WorkingSetProblem::Row& row = problem_.row(a);
      const double residual =
          problem_.leading().is_deficient(k)
              ? (Original(row).dot(best.y) - row.bound) / row.norm
              : 0;
      EXPECT_NEAR(problem_.leading().residual(a), residual, tolerance);
    }
  }
}

// Among the optima of the leading levels, y is the one closest to another y. So
// the step is in the row space of the leading levels.
TEST_P(RandomWorkingSetProblemTest, ApproachesTheOptimumOfTheLeadingLevels) {
  problem_.Plan(hierarchy_, num_levels_);
  problem_.Solve(hierarchy_, MakeSides(3));
  const Eigen::MatrixXd Q = Basis(problem_.leading(), n_);
  const Eigen::VectorXd best = y();
  std::vector<double> from(n_);
  for (int j = 0; j < n_; ++j) from[j] = 1 + j % 5;
  problem_.Approach(from);
  const double tolerance = Rounding(n_ + best.norm(), n_);
  EXPECT_LE((Q * (y() - best)).norm(), tolerance);
  const Eigen::VectorXd step = y() - Eigen::VectorXd::Map(from.data(), n_);
  EXPECT_LE((step - Q.transpose() * (Q * step)).norm(), tolerance);
}

// The first leading levels alone are approached as if there were no others, or,
// if they are merged with later ones, together with these.
TEST_P(RandomWorkingSetProblemTest, ApproachesTheFirstLeadingLevels) {
  const Sides sides = MakeSides(3);
  problem_.Plan(hierarchy_, num_levels_);
  problem_.Solve(hierarchy_, MakeSides(0));
  problem_.Solve(hierarchy_, sides);  // An update often merges levels.
  const Eigen::VectorXd from = Eigen::VectorXd::LinSpaced(n_, 1, 3);
  const std::vector<double> start(from.data(), from.data() + n_);
  for (int first = 1; first <= problem_.num_leading(); ++first) {
    SCOPED_TRACE(first);
    problem_.Approach(start, first);
    const int levels = std::max(first, problem_.leading().num_merged());
    const LexicographicOptimum nearest =
        SolveLexicographically(n_, Levels(sides, levels, from));
    EXPECT_LE(
        (y() - nearest.y).norm(),
        Rounding(kLargest, kMaxRows, nearest.condition * nearest.condition));
  }
}

// The multipliers of the distance to `from` satisfy sum_a nu_a r_a = from - y.
TEST_P(RandomWorkingSetProblemTest, FindsTheMultipliersOfAnApproach) {
  const Sides sides = MakeSides(2);
  problem_.Plan(hierarchy_, num_levels_);
  problem_.Solve(hierarchy_, sides);
  const int leading = problem_.num_leading();
  if (leading == 0) return;
  const std::vector<double> from(n_, 1);
  problem_.Approach(from);
  problem_.FindMultipliersOfApproach(from);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(n_);
  double size = 0;
  for (int a = 0; a < problem_.leading().num_rows(); ++a) {
    const WorkingSetProblem::Row& row = problem_.row(a);
    const double nu = problem_.multipliers(leading).nu[a] / row.norm;
    const Eigen::VectorXd given = row.is_inequality
                                      ? hierarchy_.C(row.level).row(row.index)
                                      : hierarchy_.B(row.level).row(row.index);
    sum += nu * given;
    size += std::abs(nu) * given.norm();
  }
  EXPECT_LE((sum - (Eigen::VectorXd::Ones(n_) - y())).norm(),
            Rounding(size + y().norm() + n_, kMaxRows));
}

// Along a trade-off p, the rows of the traded level change by W^-1 lambda, and
// those of the levels above do not change.
TEST_P(RandomWorkingSetProblemTest, FindsDirectionsThatTrade) {
  const Sides sides = MakeSides(1);
  problem_.Plan(hierarchy_, num_levels_);
  problem_.Solve(hierarchy_, sides);
  problem_.FindMultipliers(num_levels_);
  const double condition =
      SolveLexicographically(n_, Levels(sides, num_levels_, zero_)).condition;
  for (int level = 0; level < num_levels_; ++level) {
    SCOPED_TRACE(level);
    Eigen::VectorXd p(n_);
    const int traded = problem_.FindTradeOff(level, p.data());
    const WorkingSetProblem::Multipliers& of = problem_.multipliers(level);
    for (int a = 0; a < problem_.leading().num_rows(); ++a) {
      const WorkingSetProblem::Row& row = problem_.row(a);
      const int last = std::min(level, problem_.num_leading()) - 1;
      if (traded < row.level && row.level <= last) {
        // No level between is traded: it is met, or its multipliers are zero.
        if (of.any && problem_.leading().is_deficient(row.level)) {
          EXPECT_EQ(of.nu[a], 0);
        }
        continue;
      }
      if (traded < 0 || row.level > traded) continue;
      const double weight = problem_.leading().weight(a);
      const double change = weight * Original(row).dot(p) / row.norm;
      const double wanted = row.level == traded ? of.nu[a] : 0;
      EXPECT_NEAR(change, wanted,
                  Rounding(weight * p.norm() + of.size, kMaxRows,
                           condition * condition));
    }
  }
}

// A random combination of the leading rows is found again, as a sum: if rows
// depend on each other, the factors are not unique. A row with a part outside
// of their span is not found.
TEST_P(RandomWorkingSetProblemTest, FindsTheCombinationOfARow) {
  const Sides sides = MakeSides(1);
  problem_.Plan(hierarchy_, num_levels_);
  problem_.Solve(hierarchy_, sides);
  const int rows = problem_.leading().num_rows();
  if (rows == 0) return;
  Eigen::MatrixXd unit(n_, rows);
  for (int a = 0; a < rows; ++a) {
    unit.col(a) = Original(problem_.row(a)) / problem_.row(a).norm;
  }
  const Eigen::VectorXd drawn = Eigen::VectorXd::LinSpaced(rows, -1, 2);
  const Eigen::VectorXd row = unit * drawn;
  const double condition =
      SolveLexicographically(n_, Levels(sides, num_levels_, zero_)).condition;
  const double* factors = problem_.FindCombination(row.data()).factors;
  ASSERT_NE(factors, nullptr);
  const Eigen::VectorXd factor = Eigen::VectorXd::Map(factors, rows);
  const double rounding =
      Rounding(drawn.norm() + factor.norm(), kMaxRows, condition);
  EXPECT_LE((unit * factor - row).norm(), rounding);

  const JacobiSvd svd(unit);
  const double rank_tolerance =
      n_ * std::numeric_limits<double>::epsilon() * svd.sigma[0];
  if ((svd.sigma.array() > rank_tolerance).count() == n_) return;
  // The last left singular vector is orthogonal to all rows. A part of 1e-3 of
  // the row is allowed to be so.
  const Eigen::VectorXd outside = svd.U.col(n_ - 1);
  for (const double part : {0.5, 2.0, 1000.0}) {
    const Eigen::VectorXd other =
        row + part * tolerances::kIndependentPart * row.norm() * outside;
    const auto found = problem_.FindCombination(other.data());
    EXPECT_EQ(found.factors != nullptr, part < 1);
    EXPECT_NEAR(found.remainder,
                part * tolerances::kIndependentPart * row.norm(), rounding);
  }
}

// The levels before the first inequality are met by the smallest step.
TEST_P(RandomWorkingSetProblemTest, MovesToTheLevelsBeforeTheFirstInequality) {
  const Sides sides = MakeSides(1);
  problem_.Plan(hierarchy_, num_levels_);
  problem_.Solve(hierarchy_, sides);
  int first = 0;
  while (first < NumLeading(num_levels_) &&
         hierarchy_.num_inequalities(first) == 0) {
    ++first;
  }
  EXPECT_EQ(problem_.NumFirstLevels(hierarchy_), first);
  const Eigen::VectorXd from = Eigen::VectorXd::LinSpaced(n_, 1, 3);
  std::vector<double> moved(from.data(), from.data() + n_);
  problem_.MoveToFirstLevels(hierarchy_, &moved);
  const LexicographicOptimum nearest =
      SolveLexicographically(n_, Levels(sides, first, from));
  EXPECT_LE(
      (Eigen::VectorXd::Map(moved.data(), n_) - nearest.y).norm(),
      Rounding(kLargest, kMaxRows, nearest.condition * nearest.condition));
}

// More and then fewer of the leading levels are used, while the working set
// changes. A new problem has only these levels.
TEST_P(RandomWorkingSetProblemTest, UsesTheFirstLeadingLevelsOnly) {
  problem_.Plan(hierarchy_, num_levels_);
  problem_.Solve(hierarchy_, MakeSides(0));
  const int num_leading = problem_.num_leading();
  const std::vector<double> from(n_, 1);
  for (int turn = 0; turn <= 2 * num_leading; ++turn) {
    const int used = std::min(turn, 2 * num_leading - turn);
    problem_.UseLeading(used);
    WorkingSetProblem alone(n_, drawn_.capacity);
    int failed_level;
    ASSERT_EQ(alone.Read(hierarchy_, &failed_level), Status::kOptimal);
    for (const int salt : {used, used + 1}) {
      SCOPED_TRACE(testing::Message() << used << " levels, sides " << salt);
      problem_.SolveLeading(hierarchy_, MakeSides(salt));
      problem_.Approach(from);
      alone.Plan(hierarchy_, used);
      alone.UseLeading(used);  // Also if the last of them are diagonal.
      alone.SolveLeading(hierarchy_, MakeSides(salt));
      alone.Approach(from);
      const Eigen::VectorXd wanted = Eigen::VectorXd::Map(alone.y().data(), n_);
      const LexicographicOptimum optimum =
          SolveLexicographically(n_, Levels(MakeSides(salt), used, zero_));
      EXPECT_LE(
          (y() - wanted).norm(),
          Rounding(kLargest, kMaxRows, optimum.condition * optimum.condition));
    }
  }
}

// Without the levels that are left out, the problem is one that never had them.
// If all are solved, none is left out.
TEST_P(RandomWorkingSetProblemTest, LeavesOutWhatIsNotSolved) {
  const Sides sides = MakeSides(2);
  problem_.Plan(hierarchy_, num_levels_);
  problem_.Solve(hierarchy_, sides);
  problem_.LeaveOutUnsolved();
  ASSERT_EQ(problem_.num_levels(), num_levels_);
  const int used = std::max(problem_.num_leading() - 1, 0);
  problem_.UseLeading(used);
  if (GetParam() % 2 == 0) problem_.SolveLeading(hierarchy_, sides);
  problem_.LeaveOutUnsolved();
  EXPECT_EQ(problem_.num_levels(), used);
  EXPECT_EQ(problem_.num_leading(), used);
  problem_.FindAllMultipliers();

  WorkingSetProblem alone(n_, drawn_.capacity);
  int failed_level;
  ASSERT_EQ(alone.Read(hierarchy_, &failed_level), Status::kOptimal);
  alone.Plan(hierarchy_, used);
  alone.UseLeading(used);
  alone.SolveLeading(hierarchy_, sides);
  alone.FindMultipliers(used);
  const int rows = problem_.leading().num_rows();
  ASSERT_EQ(rows, alone.leading().num_rows());
  for (int a = 0; a < rows; ++a) EXPECT_LT(problem_.row(a).level, used);
  for (int k = 0; k < used; ++k) {
    EXPECT_EQ(problem_.multipliers(k).any, alone.multipliers(k).any);
    if (!alone.multipliers(k).any) continue;
    for (int a = 0; a < problem_.leading().first_row(k); ++a) {
      EXPECT_EQ(problem_.multipliers(k).nu[a], alone.multipliers(k).nu[a]);
    }
  }
}

// Most inequalities bound one variable. A problem that was solved before
// factors the levels that it has met at once, with fixed variables. It then
// finds the optimum of a new problem, and the same step to the first levels.
TEST(FixedVariablesOfAWorkingSet, GiveTheOptimumOfANewProblem) {
  int num_fixed = 0, num_moved = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    RandomHierarchyOptions options;
    options.max_equalities = 3;
    options.max_inequalities = 3 + seed % 2;
    options.degenerate = 5;
    options.scaled = 0;
    options.bounds = 80;
    const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    const Hierarchy& hierarchy = drawn.hierarchy;
    const int n = hierarchy.num_variables(), levels = hierarchy.num_levels();
    WorkingSetProblem problem(n, drawn.capacity);
    int failed_level;
    ASSERT_EQ(problem.Read(hierarchy, &failed_level), Status::kOptimal);
    for (int salt = 0; salt < 4; ++salt) {
      Sides sides;
      for (int k = 0; k < levels; ++k) {
        sides.emplace_back(drawn.capacity[k].inequalities, Side::kNone);
        for (int i = 0; i < hierarchy.num_inequalities(k); ++i) {
          if ((i + k + salt) % 3 == 0) continue;
          sides[k][i] = std::isfinite(hierarchy.upper(k)[i]) ? Side::kUpper
                                                             : Side::kLower;
        }
      }
      problem.Plan(hierarchy, levels);
      std::vector<double> moved(n, 1), expected(n, 1);
      problem.Start(hierarchy, sides, &moved);
      problem.SolveDiagonal();
      const int fixed = problem.leading().variables().size();
      num_fixed += fixed;
      num_moved += fixed > 0 && moved != std::vector<double>(n, 1);
      WorkingSetProblem alone(n, drawn.capacity);
      ASSERT_EQ(alone.Read(hierarchy, &failed_level), Status::kOptimal);
      alone.Plan(hierarchy, levels);
      alone.Solve(hierarchy, sides);
      EXPECT_EQ(alone.leading().variables().size(), 0);
      alone.MoveToFirstLevels(hierarchy, &expected);
      problem.Refine(hierarchy);
      alone.Refine(hierarchy);
      for (int j = 0; j < n; ++j) {
        // Rounding, multiplied by the condition of rows that an update accepts.
        const double tolerance = 1e-9 * (1 + std::abs(alone.y()[j]));
        EXPECT_NEAR(problem.y()[j], alone.y()[j], tolerance) << salt;
        EXPECT_NEAR(moved[j], expected[j], tolerance) << salt;
      }
    }
  }
  EXPECT_GT(num_fixed, kSeeds);
  EXPECT_GT(num_moved, 10);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomWorkingSetProblemTest,
                         testing::Range(0, kSeeds));

}  // namespace
}  // namespace poise
