// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/working_set_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/same_sides.h"
#include "poise/hqp/fast/tolerances.h"

namespace poise {
namespace {

constexpr int kNoKey = LexicographicFactorization::kNoKey;

// Most rows have one entry.
double Norm(const double* row, Span span) {
  if (span.size == 1) return std::abs(row[span.first]);
  return std::sqrt(kernels::SquaredNorm(row + span.first, span.size));
}

}  // namespace

WorkingSetProblem::WorkingSetProblem(int num_variables,
                                     const std::vector<LevelCapacity>& capacity,
                                     int max_leading_rows, int max_kept_rows)
    : n_(num_variables),
      leading_(num_variables, max_leading_rows,
               static_cast<int>(capacity.size()), max_kept_rows),
      diagonal_(num_variables, static_cast<int>(capacity.size())),
      rows_(max_leading_rows),
      multipliers_(capacity.size() + 1),
      y_(num_variables),
      gradient_(num_variables),
      change_(num_variables),
      nu_(rows_.size()),
      row_residual_(rows_.size()),
      size_(rows_.size()),
      norm_(rows_.size()) {
  for (const LevelCapacity& level : capacity) {
    norm_begin_.push_back(0);
    factored_.emplace_back(level.inequalities, Side::kNone);
    B_norm_.emplace_back(level.equalities);
    selected_.emplace_back(level.equalities, 0);
  }
  for (Multipliers& multipliers : multipliers_) {
    multipliers.nu.resize(rows_.size());
    multipliers.left.resize(num_variables);
  }
}

// Returns whether the level fits into its capacity.
bool WorkingSetProblem::Fits(const Hierarchy& hierarchy, int level) const {
  return level < static_cast<int>(B_norm_.size()) &&
         hierarchy.num_equalities(level) <=
             static_cast<int>(B_norm_[level].size()) &&
         hierarchy.num_inequalities(level) <=
             static_cast<int>(factored_[level].size());
}

// Returns whether the leading levels together fit into the factorisation.
bool WorkingSetProblem::LeadingLevelsFit(const Hierarchy& hierarchy) {
  const int most = static_cast<int>(rows_.size());
  int level = hierarchy.num_levels(), rows = 0;
  for (int k = 0; k < level; ++k) {
    rows += hierarchy.num_equalities(k) + hierarchy.num_inequalities(k);
  }
  while (rows > most && --level >= 0 && IsDiagonal(hierarchy, level)) {
    rows -= hierarchy.num_equalities(level);
  }
  return rows <= most;
}

// Returns whether a level has no inequalities, and each row has one variable.
// Finds these variables.
bool WorkingSetProblem::IsDiagonal(const Hierarchy& hierarchy, int level) {
  if (hierarchy.num_inequalities(level) > 0 || n_ == 0) return false;
  const auto B = hierarchy.B(level);
  for (int i = 0; i < B.rows(); ++i) {
    if (IsLeftOut(level, i)) continue;
    const double* row = B.data() + i * n_;
    int& variable = selected_[level][i];
    // In a longer span, an entry may be too small to change the norm.
    const Span span = hierarchy.B_span(level)[i];
    const auto is_zero = [](double entry) { return entry == 0; };
    if (span.size > 1 &&
        std::count_if(row + span.first, row + span.first + span.size, is_zero) <
            span.size - 1) {
      return false;
    }
    // The variable is usually the same as in the last tick.
    if (std::abs(row[variable]) == B_norm_[level][i]) continue;
    variable =
        static_cast<int>(std::max_element(row, row + n_,
                                          [](double x, double y) {
                                            return std::abs(x) < std::abs(y);
                                          }) -
                         row);
  }
  return true;
}

Status WorkingSetProblem::Read(const Hierarchy& hierarchy, int* failed_level) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  *failed_level = 0;
  before_ = leading_.multiply_adds() + diagonal_.multiply_adds();
  work_ = {};
  if (hierarchy.num_variables() != n_) return Status::kBadInput;
  int inequalities = 0;  // These are all in leading levels.
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    *failed_level = level;
    if (!Fits(hierarchy, level)) return Status::kBadInput;
    norm_begin_[level] = inequalities;
    inequalities += hierarchy.num_inequalities(level);
    if (inequalities > static_cast<int>(norm_.size())) return Status::kBadInput;
    const auto B = hierarchy.B(level), C = hierarchy.C(level);
    const auto b = hierarchy.b(level), weight = hierarchy.weight(level);
    const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
    double zero = 0;  // NaN if a number, or the square of a row, is not finite.
    bool in_order = true;
    kernels::SpanAbsoluteSums(B.data(), n_, hierarchy.B_span(level),
                              hierarchy.num_equalities(level),
                              B_norm_[level].data());
    for (int i = 0; i < B.rows(); ++i) {
      double& norm = B_norm_[level][i];
      work_.num_entries += hierarchy.B_span(level)[i].size;
      zero += norm * norm * weight[i] * 0 + b[i] * 0 + weight[i] * 0;
      in_order &= !(weight[i] < 0);
      if (weight[i] > 0 && norm * norm * weight[i] < tolerances::kZeroRow)
        norm = 0;
    }
    kernels::SpanAbsoluteSums(C.data(), n_, hierarchy.C_span(level),
                              hierarchy.num_inequalities(level),
                              norm_.data() + norm_begin_[level]);
    for (int i = 0; i < C.rows(); ++i) {
      double& norm = norm_[norm_begin_[level] + i];
      work_.num_entries += hierarchy.C_span(level)[i].size;
      zero += norm * norm * 0;
      if (norm * norm < tolerances::kZeroRow) norm = 0;
      if (!(lower[i] < kInfinity && upper[i] > -kInfinity)) {
        return Status::kNotFinite;
      }
      in_order &= lower[i] <= upper[i];
    }
    if (zero != 0) return Status::kNotFinite;
    if (!in_order) return Status::kBadInput;
  }
  if (!LeadingLevelsFit(hierarchy)) return Status::kBadInput;
  *failed_level = -1;
  return Status::kOptimal;
}

void WorkingSetProblem::Plan(const Hierarchy& hierarchy, int num_levels,
                             const double* center) {
  num_levels_ = num_levels;
  num_leading_ = num_levels;
  is_factored_ = false;
  is_planned_ = true;
  diagonal_.Clear();
  // Diagonal levels are the last levels without inequalities whose rows have
  // one variable each.
  while (num_leading_ > 0 && IsDiagonal(hierarchy, num_leading_ - 1)) {
    --num_leading_;
  }
  planned_leading_ = num_leading_;
  for (int level = num_leading_; level < num_levels; ++level) {
    diagonal_.AddLevel();
    for (int i = 0, rows = hierarchy.num_equalities(level); i < rows; ++i) {
      if (IsLeftOut(level, i)) continue;
      const double scale = hierarchy.B(level)(i, selected_[level][i]);
      diagonal_.Add(selected_[level][i],
                    hierarchy.weight(level)[i] * scale * scale,
                    -hierarchy.b(level)[i] / scale);
    }
  }
  diagonal_.Finish(center);
}

void WorkingSetProblem::UseLeading(int num_leading) {
  num_leading_ = num_leading;
  is_diagonal_solved_ = false;
  if (leading_.num_levels() <= num_leading) return;
  leading_.Truncate(num_leading);
  // Merged levels are gone together.
  is_factored_ = is_factored_ && leading_.num_rows() > 0;
}

void WorkingSetProblem::LeaveOutUnsolved() {
  if (is_diagonal_solved_) return;
  num_leading_ = num_levels_ = leading_.num_levels();
}

// Adds a row to the level that is factored next. A row with a key, 0 or more,
// is not copied if its projection is known.
void WorkingSetProblem::AddRow(const Row& row, const double* from,
                               double metric, int key) {
  const int a = leading_.AddRow(row.bound / row.norm, metric * row.norm);
  rows_[a] = row;
  if (key != kNoKey && leading_.Recall(a, key)) return;
  leading_.SetRow(a, from, row.span.first, row.span.first + row.span.size,
                  row.norm);
}

double WorkingSetProblem::Bound(const Hierarchy& hierarchy, int level, int i,
                                Side side) {
  return side == Side::kUpper ? hierarchy.upper(level)[i]
                              : hierarchy.lower(level)[i];
}

WorkingSetProblem::Row WorkingSetProblem::Inequality(const Hierarchy& hierarchy,
                                                     int level, int i,
                                                     Side side) const {
  const double* row = hierarchy.C(level).data() + i * n_;
  const double bound = Bound(hierarchy, level, i, side);
  const Span span = hierarchy.C_span(level)[i];
  return {level, i, true, span, Norm(row, span), bound};
}

// Factors the levels from `from_level` on. If `keeps`, the rows' projections on
// the merged levels are kept for the next time.
void WorkingSetProblem::FactorFrom(const Hierarchy& hierarchy,
                                   const std::vector<std::vector<Side>>& side,
                                   int from_level, bool keeps) {
  leading_.Truncate(from_level);
  int key = 0;  // The key of the level's first row counts all rows before.
  for (int level = 0; level < num_leading_; ++level) {
    if (level >= from_level) {
      FactorLevel(hierarchy, side[level], level, keeps ? key : kNoKey);
      if (leading_.num_levels() <= level) return;  // Interrupted.
    }
    key += hierarchy.num_equalities(level) + hierarchy.num_inequalities(level);
  }
}

void WorkingSetProblem::FactorLevel(const Hierarchy& hierarchy,
                                    const std::vector<Side>& side, int level,
                                    int first_key) {
  ForEachRow(
      hierarchy, side, level, [](Span) { return true; },
      [&](const Row& row, double metric, int i) {
        AddRow(row, Original(hierarchy, row), metric,
               first_key == kNoKey ? kNoKey : first_key + i);
      });
  leading_.FactorLevel();
  factored_[level] = side;
}

// Calls use(row, metric, number) for the rows of a level that are not zero and
// whose span is selected: for the equalities, and then for the inequalities in
// the working set.
template <typename Selects, typename Use>
void WorkingSetProblem::ForEachRow(const Hierarchy& hierarchy,
                                   const std::vector<Side>& side, int level,
                                   const Selects& selects,
                                   const Use& use) const {
  const int equalities = hierarchy.num_equalities(level);
  for (int i = 0; i < equalities; ++i) {
    const double weight = hierarchy.weight(level)[i];
    const Span span = hierarchy.B_span(level)[i];
    if (weight == 0 || B_norm_[level][i] == 0 || !selects(span)) continue;
    const double* row = hierarchy.B(level).data() + i * n_;
    const double target = -hierarchy.b(level)[i];
    use(Row{level, i, false, span, Norm(row, span), target}, std::sqrt(weight),
        i);
  }
  for (int i = 0, rows = hierarchy.num_inequalities(level); i < rows; ++i) {
    if (side[i] == Side::kNone || norm(level, i) == 0 ||
        !selects(hierarchy.C_span(level)[i])) {
      continue;
    }
    use(Inequality(hierarchy, level, i, side[i]), 1, equalities + i);
  }
}

// Factors the first `met` levels, merged, and then the others. Returns false,
// without a level that is factored, if no row of the first ones fixes a
// variable, if one of their rows depends on others, or if there are no
// multiply-adds left.
bool WorkingSetProblem::FactorMerged(const Hierarchy& hierarchy,
                                     const std::vector<std::vector<Side>>& side,
                                     int met) {
  leading_.Truncate(0);
  for (const bool fixes : {true, false}) {
    for (int level = 0; level < met; ++level) {
      bool fits = true;
      ForEachRow(
          hierarchy, side[level], level,
          [&](Span span) { return (span.size == 1) == fixes; },
          [&](const Row& row, double metric, int) {
            if (!fixes) {
              AddRow(row, Original(hierarchy, row), metric, kNoKey);
            } else {
              fits = fits && AddFixedVariable(hierarchy, row, metric);
            }
          });
      if (!fits) return false;
    }
    if (leading_.num_rows() == 0) return false;
  }
  if (!leading_.FactorMerged(met)) return false;
  for (int level = 0; level < met; ++level) factored_[level] = side[level];
  FactorFrom(hierarchy, side, met, true);
  leading_.ForgetUnused();
  return true;
}

// Returns false if another row fixes the variable.
bool WorkingSetProblem::AddFixedVariable(const Hierarchy& hierarchy,
                                         const Row& row, double metric) {
  const int variable = row.span.first;
  if (leading_.variables().is_fixed(variable)) return false;
  const double entry = Original(hierarchy, row)[variable] / row.norm;
  const int a = leading_.AddFixedVariable(variable, entry, row.bound / row.norm,
                                          metric * row.norm);
  rows_[a] = row;
  return true;
}

void WorkingSetProblem::SolveLeading(
    const Hierarchy& hierarchy, const std::vector<std::vector<Side>>& side) {
  // If a level depends on those before, these may still be merged.
  int met = std::min(num_met_, num_leading_);
  if (!is_factored_ || !Update(hierarchy, side, &met)) {
    while (met > 0 && !FactorMerged(hierarchy, side, met)) --met;
    if (met == 0) FactorFrom(hierarchy, side, 0, false);
  }
  num_met_ = is_planned_ ? NumMet() : std::max(num_met_, NumMet());
  is_planned_ = false;
  is_factored_ = true;
  is_diagonal_solved_ = false;
  CountWork();
}

bool WorkingSetProblem::SolveLeadingWithin(
    const Hierarchy& hierarchy, const std::vector<std::vector<Side>>& side,
    Budget* budget) {
  leading_.set_max_multiply_adds(leading_.multiply_adds() +
                                 budget->MultiplyAddsLeft(work()));
  SolveLeading(hierarchy, side);
  leading_.set_max_multiply_adds(std::numeric_limits<std::int64_t>::max());
  if (leading_.num_levels() == num_leading_) return true;
  budget->Spend();
  return false;
}

// Counts the working set that has been solved, and its inequalities.
void WorkingSetProblem::CountWork() {
  work_.num_active = 0;
  for (int a = 0; a < leading_.num_rows(); ++a) {
    work_.num_active += rows_[a].is_inequality ? 1 : 0;
  }
  if (num_leading_ < planned_leading_) {
    ++work_.num_partly_solved;
  } else {
    ++work_.num_solved;
  }
  work_.sum_active += work_.num_active;
}

Work WorkingSetProblem::WorkWith(
    const Hierarchy& hierarchy,
    const std::vector<std::vector<Side>>& side) const {
  Work work = this->work();
  work.num_active = 0;
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    for (int i = 0, rows = hierarchy.num_inequalities(level); i < rows; ++i) {
      work.num_active += side[level][i] != Side::kNone ? 1 : 0;
    }
  }
  return work;
}

// Returns the number of factored levels before the first deficient one.
int WorkingSetProblem::NumMet() const {
  int met = 0;
  while (met < leading_.num_levels() && !leading_.is_deficient(met)) ++met;
  return met;
}

void WorkingSetProblem::Start(const Hierarchy& hierarchy,
                              const std::vector<std::vector<Side>>& side,
                              std::vector<double>* y) {
  const int num_leading = num_leading_, met = num_met_;
  const bool merges = FixesVariables(hierarchy, side);
  if (merges) {
    UseLeading(NumFirstLevels(hierarchy));
    SolveLeading(hierarchy, side);
    MoveToFirstLevels(hierarchy, y);
    is_factored_ = false;
    is_planned_ = true;
    num_met_ = met;
    UseLeading(num_leading);
  }
  SolveLeading(hierarchy, side);
  if (!merges) MoveToFirstLevels(hierarchy, y);
}

// Returns whether FactorMerged() can fix a variable.
bool WorkingSetProblem::FixesVariables(
    const Hierarchy& hierarchy,
    const std::vector<std::vector<Side>>& side) const {
  bool any = false;
  for (int level = 0; level < std::min(num_met_, num_leading_); ++level) {
    ForEachRow(
        hierarchy, side[level], level, [](Span span) { return span.size == 1; },
        [&](const Row&, double, int) { any = true; });
  }
  return any;
}

void WorkingSetProblem::Approach(const std::vector<double>& y, int num_levels) {
  y_ = y;
  const int levels = std::max(num_levels, leading_.num_merged());
  if (levels > 0) MoveTo(leading_.rank(levels - 1), &y_);
}

int WorkingSetProblem::NumFirstLevels(const Hierarchy& hierarchy) const {
  int levels = 0;
  while (levels < num_leading_ && hierarchy.num_inequalities(levels) == 0) {
    ++levels;
  }
  return levels;
}

void WorkingSetProblem::MoveToFirstLevels(const Hierarchy& hierarchy,
                                          std::vector<double>* y) {
  const int levels = NumFirstLevels(hierarchy);
  if (levels > 0) MoveTo(leading_.rank(levels - 1), y);
}

// Adds Q' (z - Q y) to y, with the first `rank` rows of Q.
void WorkingSetProblem::MoveTo(int rank, std::vector<double>* y) {
  leading_.Project(y->data(), rank, change_.data());
  for (int e = 0; e < rank; ++e) change_[e] = leading_.z()[e] - change_[e];
  leading_.AddCombination(change_.data(), rank, y->data());
}

// Adds factor times row a, scaled to unit length, to `sum`.
void WorkingSetProblem::AddToSum(const Hierarchy& hierarchy, int a,
                                 double factor, double* sum) const {
  if (factor == 0) return;
  factor /= rows_[a].norm;
  const Span span = rows_[a].span;
  kernels::AddRows(Original(hierarchy, rows_[a]) + span.first, 0, 1, &factor,
                   span.size, sum + span.first);
}

const double* WorkingSetProblem::Original(const Hierarchy& hierarchy,
                                          const Row& row) const {
  return row.is_inequality ? hierarchy.C(row.level).data() + row.index * n_
                           : hierarchy.B(row.level).data() + row.index * n_;
}

}  // namespace poise
