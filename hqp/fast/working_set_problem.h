// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "poise/hqp/fast/budget.h"
#include "poise/hqp/fast/diagonal_levels.h"
#include "poise/hqp/fast/lexicographic_factorization.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {

/// Solves a hierarchy whose working set is taken as equalities of their own
/// levels. The leading levels are solved by one LexicographicFactorization, the
/// last levels whose rows have one variable by DiagonalLevels. The norm of y is
/// one more level below the last.
class WorkingSetProblem {
 public:
  WorkingSetProblem(int num_variables,
                    const std::vector<LevelCapacity>& capacity)
      : WorkingSetProblem(num_variables, capacity, NumRows(capacity),
                          2 * num_variables) {}

  /// @param max_leading_rows  largest number of rows of all leading levels
  ///                          together; it determines the memory.
  /// @param max_kept_rows  rows of deficient levels whose projection is kept
  ///                       between two updates. All others are projected anew.
  WorkingSetProblem(int num_variables,
                    const std::vector<LevelCapacity>& capacity,
                    int max_leading_rows, int max_kept_rows);

  /// A row of the leading levels, as given in the hierarchy.
  struct Row {
    int level, index;
    bool is_inequality;
    Span span;
    double norm;   ///< |row|_2.
    double bound;  ///< -b, or the active bound.
  };

  /// Multipliers of a level, or of the norm of y, on the rows of the levels
  /// above.
  struct Multipliers {
    bool any = false;          ///< Whether the gradient is nonzero.
    double size = 0;           ///< Magnitude of the terms.
    std::vector<double> nu;    ///< By leading row of unit length.
    std::vector<double> left;  ///< DiagonalLevels::Dual(): by variable.
  };

  /// Reads a hierarchy's sizes and the norms of its rows, and checks its
  /// numbers as CheckInput() does: kNotFinite if one is not finite or too
  /// large, or a bound infinite on the wrong side; kBadInput if lower > upper,
  /// a weight is negative, or it has more rows or other variables than there is
  /// room for. failed_level is the first such level.
  Status Read(const Hierarchy& hierarchy, int* failed_level);

  /// Forgets which levels were met.
  void Forget() { num_met_ = 0; }

  /// Uses the first num_levels levels only. In the nullspace that they leave, y
  /// is the point closest to `center`, or to zero.
  void Plan(const Hierarchy& hierarchy, int num_levels,
            const double* center = nullptr);

  /// Uses the first num_leading levels only, as leading levels, until it is
  /// called again or the next Plan(). What is factored of them stays. Call
  /// SolveLeading() and Approach() next: SolveDiagonal() needs all leading
  /// levels.
  void UseLeading(int num_leading);
  /// UseLeading() for all leading levels of the last Plan().
  void UseAllLeading() { UseLeading(planned_leading_); }

  /// Leaves out the levels that the last SolveLeading() has not solved, until
  /// the next Plan().
  void LeaveOutUnsolved();

  /// Solves for the working set `side`, by level. The first time after Plan(),
  /// the levels that were met last time may be merged. After that, the last
  /// factorisation is updated where that is accurate. The factored rows are
  /// then not in the order of their levels.
  void Solve(const Hierarchy& hierarchy,
             const std::vector<std::vector<Side>>& side) {
    SolveLeading(hierarchy, side);
    SolveDiagonal();
  }

  /// Solve() with SolveLeadingWithin(). Returns false if it is interrupted.
  [[nodiscard]] bool SolveWithin(const Hierarchy& hierarchy,
                                 const std::vector<std::vector<Side>>& side,
                                 Budget* budget) {
    if (!SolveLeadingWithin(hierarchy, side, budget)) return false;
    SolveDiagonal();
    return true;
  }

  /// SolveLeading() after Plan(), and MoveToFirstLevels() for y, which is the
  /// start of a search.
  void Start(const Hierarchy& hierarchy,
             const std::vector<std::vector<Side>>& side,
             std::vector<double>* y);

  /// Solve() in two steps: the factorisation of the leading levels, and then y.
  void SolveLeading(const Hierarchy& hierarchy,
                    const std::vector<std::vector<Side>>& side);
  /// SolveLeading(), but the factorisation of levels stops when the budget has
  /// no multiply-adds left. The levels before stay, and those after them are
  /// left out. Returns false in this case, and spends the budget. Updates of
  /// merged rows do not stop.
  [[nodiscard]] bool SolveLeadingWithin(
      const Hierarchy& hierarchy, const std::vector<std::vector<Side>>& side,
      Budget* budget);
  void SolveDiagonal() {
    diagonal_.Solve(leading_, y_.data());
    is_diagonal_solved_ = true;
  }

  /// Replaces SolveDiagonal(): takes the optimum of the leading levels closest
  /// to y, and ignores the diagonal levels.
  void Approach(const std::vector<double>& y) {
    Approach(y, leading_.num_levels());
  }

  /// Approach() for the first `num_levels` leading levels. If they are merged
  /// with later ones, y is the optimum of all merged levels.
  void Approach(const std::vector<double>& y, int num_levels);

  /// Returns the number of first levels, all leading, without inequalities. No
  /// search can change these levels.
  int NumFirstLevels(const Hierarchy& hierarchy) const;

  /// Moves y to the closest optimum of these first levels.
  /// pre: Solve() has factored them in their order, neither updated nor merged
  /// with later levels; Start() sees to it.
  void MoveToFirstLevels(const Hierarchy& hierarchy, std::vector<double>* y);

  /// Iterative refinement: reduces the residuals of the rows as given, until
  /// each is zero to rounding of its own terms. Orthogonalisation alone leaves
  /// rounding of the largest entries of y, which a level need not contain.
  void Refine(const Hierarchy& hierarchy) { Refine(hierarchy, true); }

  /// Refines another y that meets the rows, without a step to the optimum in
  /// their nullspace.
  void RefineFrom(const Hierarchy& hierarchy, const std::vector<double>& y);

  /// Sets y without refinement, and computes the residuals at this y.
  void SetSolution(const Hierarchy& hierarchy, const std::vector<double>& y);

  /// Sets entries of y that may be rounding of zero to zero: those of a row
  /// that y violates, and others of y if that helps. No residual of the working
  /// set may increase by more than its last digit. Returns whether an entry
  /// changed.
  bool ZeroRoundingEntries(const Hierarchy& hierarchy, const double* row);

  /// Computes the multipliers of the levels before `end` at the last solve. The
  /// norm of y is level num_levels().
  void FindMultipliers(int end);

  /// Computes the multipliers of the leading levels after Approach(y), and
  /// those of the distance to y as level num_leading().
  void FindMultipliersOfApproach(const std::vector<double>& y);

  /// Computes the multipliers of all levels, and of the norm of y. If levels
  /// are left out, those of the others.
  void FindAllMultipliers() {
    FindMultipliers(is_diagonal_solved_ ? num_levels_ + 1 : num_levels_);
  }

  /// Refines the multipliers by the residual of stationarity, from the rows as
  /// given. Those of a leading level are followed by the weighted residuals of
  /// its own rows, d_a^2 (r_a y - t_a), corrected for rounding.
  void RefineMultipliers(const Hierarchy& hierarchy);

  /// Finds LevelSolution::trade_off for a level.
  /// @return  the last deficient level above on which this level has
  ///          multipliers, or -1 if there is none.
  /// pre: FindMultipliers().
  int FindTradeOff(int level, double* trade_off);

  /// A row as a sum of the leading rows.
  struct Combination {
    /// By leading row of unit length. Null: independent. May be overwritten.
    double* factors;
    double remainder;  ///< Length of the part that is not in the sum.
  };
  /// Finds the combination of the leading rows that is closest to `row`, of
  /// num_variables numbers. Has no factors if the remainder is above
  /// kIndependentPart of the length of `row`. If the leading rows depend on
  /// each other, the factors are not unique. They are valid until the next
  /// call. pre: SolveLeading().
  [[nodiscard]] Combination FindCombination(const double* row);

  /// Multiplier of an inequality row in a level's optimality condition.
  /// Positive: binding. Negative: removing the row lowers the cost. Zero if
  /// below tolerance, relative. On the row's own level it is the violation.
  double Multiplier(int row, int level, Side side, double tolerance) const {
    const double sign = static_cast<double>(side);
    if (level == rows_[row].level) return sign * leading_.residual(row);
    const Multipliers& of = multipliers_[level];
    const bool is_zero = !of.any || std::abs(of.nu[row]) <= tolerance * of.size;
    return is_zero ? 0 : sign * of.nu[row];
  }

  /// Work since Read(). Products with all rows are not in its multiply-adds:
  /// they are the same in each iteration.
  Work work() const {
    Work work = work_;
    work.multiply_adds =
        leading_.multiply_adds() + diagonal_.multiply_adds() - before_;
    return work;
  }

  /// Returns work(), but with the inequalities of `side`, which are solved
  /// next: the time after the search depends on their number.
  Work WorkWith(const Hierarchy& hierarchy,
                const std::vector<std::vector<Side>>& side) const;

  /// Returns whether no leading level that has been solved is deficient.
  bool meets_leading() const { return NumMet() == leading_.num_levels(); }
  int num_levels() const { return num_levels_; }
  int num_leading() const { return num_leading_; }  ///< Leading levels.
  const LexicographicFactorization& leading() const { return leading_; }
  /// Releases the memory of leading() for another factorisation. Call Plan()
  /// and Solve() before leading() is used again.
  LexicographicFactorization& ReleaseLeading() {
    is_factored_ = false;
    return leading_;
  }
  DiagonalLevels& diagonal() { return diagonal_; }
  const DiagonalLevels& diagonal() const { return diagonal_; }
  const Row& row(int a) const { return rows_[a]; }
  const Multipliers& multipliers(int level) const {
    return multipliers_[level];
  }
  const std::vector<double>& y() const { return y_; }

  /// The largest of |y|, of the targets of the working set by unit row, and of
  /// the targets of the diagonal levels. Rounding of y is relative to it, even
  /// where these targets cancel in y.
  double Size() const;

  /// Sum of absolute entries of row i of C.
  double norm(int level, int i) const { return norm_[norm_begin_[level] + i]; }
  /// Returns whether row i of B is zero, or so small that it is left out.
  bool IsLeftOut(int level, int i) const { return B_norm_[level][i] == 0; }
  /// Variable of row i of B in a diagonal level, if the row is not left out.
  int selected(int level, int i) const { return selected_[level][i]; }

 private:
  void AddRow(const Row& row, const double* from, double metric, int key);
  void CountWork();
  static double Bound(const Hierarchy& hierarchy, int level, int i, Side side);
  Row Inequality(const Hierarchy& hierarchy, int level, int i, Side side) const;
  template <typename Selects, typename Use>
  void ForEachRow(const Hierarchy& hierarchy, const std::vector<Side>& side,
                  int level, const Selects& selects, const Use& use) const;
  int NumMet() const;
  bool FixesVariables(const Hierarchy& hierarchy,
                      const std::vector<std::vector<Side>>& side) const;
  bool FactorMerged(const Hierarchy& hierarchy,
                    const std::vector<std::vector<Side>>& side, int met);
  bool AddFixedVariable(const Hierarchy& hierarchy, const Row& row,
                        double metric);
  bool AppendInequality(const Hierarchy& hierarchy, int level, int i,
                        Side side);
  void FactorFrom(const Hierarchy& hierarchy,
                  const std::vector<std::vector<Side>>& side, int from_level,
                  bool keeps);
  void FactorLevel(const Hierarchy& hierarchy, const std::vector<Side>& side,
                   int level, int first_key);
  bool Update(const Hierarchy& hierarchy,
              const std::vector<std::vector<Side>>& side, int* mergeable);
  void SetSide(const Hierarchy& hierarchy, int a, Side side);
  void ChangeSides(const Hierarchy& hierarchy,
                   const std::vector<std::vector<Side>>& side, int from,
                   int met);
  int NumChanges(const std::vector<std::vector<Side>>& side, int met) const;
  bool IsFactoringFaster(const Hierarchy& hierarchy,
                         const std::vector<std::vector<Side>>& side, int met,
                         int rank, int changes) const;
  bool AppendAll(const Hierarchy& hierarchy,
                 const std::vector<std::vector<Side>>& side, int* met);
  bool RemoveLevels(const Hierarchy& hierarchy,
                    const std::vector<std::vector<Side>>& side, int level);
  void MoveTo(int rank, std::vector<double>* y);
  void RemoveRow(int a);
  void AddToSum(const Hierarchy& hierarchy, int a, double factor,
                double* sum) const;
  const double* Original(const Hierarchy& hierarchy, const Row& row) const;
  double ComputeRowResiduals(const Hierarchy& hierarchy);
  bool Fits(const Hierarchy& hierarchy, int level) const;
  bool LeadingLevelsFit(const Hierarchy& hierarchy);
  bool IsDiagonal(const Hierarchy& hierarchy, int level);
  bool IsAtTarget(int j) const;
  double RelativeResidual(int a) const;
  double WorstRelativeLevelResidual() const;
  bool IsUneven() const;
  void Refine(const Hierarchy& hierarchy, bool to_minimum);
  bool ZeroNegligibleEntries(double largest);
  bool TryZeros(const Hierarchy& hierarchy, double largest);
  void UpdateDeficientResiduals(const Hierarchy& hierarchy);
  void TakeDeficientResiduals();

  int n_;
  int num_levels_ = 0, num_leading_ = 0;
  /// Largest number of leading levels before the first deficient one, of all
  /// solutions since Plan(). Until the first solution it is that of the last
  /// plan.
  int num_met_ = 0;
  bool is_planned_ = false;  ///< No solution since Plan().
  bool is_factored_ = false;
  bool is_diagonal_solved_ = false;  ///< Since the last SolveLeading().
  int planned_leading_ = 0;          ///< Leading levels of Plan().
  Work work_;                ///< Since Read(), but for its multiply-adds.
  std::int64_t before_ = 0;  ///< Multiply-adds before Read().
  std::vector<std::vector<Side>> factored_;  ///< Factored working set.
  LexicographicFactorization leading_;
  DiagonalLevels diagonal_;
  std::vector<Row> rows_;
  std::vector<Multipliers> multipliers_;
  std::vector<double> y_, gradient_, change_, nu_;
  std::vector<double> row_residual_, size_;  ///< By leading row.
  std::vector<double> norm_;                 ///< By inequality of all levels.
  std::vector<int> norm_begin_;  ///< First entry of norm_, by level.
  std::vector<std::vector<double>> B_norm_;
  std::vector<std::vector<int>> selected_;
};

}  // namespace poise
