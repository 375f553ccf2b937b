// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.

// The part of DiagonalLevels that updates its factors when rows of the leading
// levels were added or removed.

#include <algorithm>
#include <cmath>

#include "poise/hqp/fast/diagonal_levels.h"
#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/tolerances.h"

namespace poise {
namespace {

using kernels::AddRows;
using kernels::Dots;
using kernels::Rotate;
using kernels::SquaredNorm;

// Most directions that an update adds. In robots, each takes a tenth of the
// work of another factorisation. One that is removed takes a quarter, so only
// one is.
constexpr int kMaxAdded = 4;

}  // namespace

// Makes the row spaces of T and Q the same, if kMaxAdded directions are added
// at most, or one is removed or exchanged. Returns false if that is not
// possible.
bool DiagonalLevels::UpdateFactors(const LexicographicFactorization& leading) {
  for (int p = num_free_; p < n_; ++p) {
    if (!leading.variables().is_fixed(order_[p]) && !Release(p)) return false;
  }
  const int growth = leading.rank() - num_fixed() - rank_;
  if (growth == 0 && HasRowSpaceOf(leading)) return true;
  if (growth > kMaxAdded || growth < -1 || !HasSquareLaterLevels()) {
    return false;
  }
  const int added = growth == 0 ? 1 : std::max(growth, 0);
  if (IsFactoringFaster(leading, added, growth <= 0 ? 1 : 0)) return false;
  for (int power = 1; power <= added; ++power) {
    if (!(FindAdded(leading, power) && AppendDirection())) return false;
  }
  if (growth <= 0 && !(FindRemoved(leading) && RemoveDirection())) return false;
  return HasRowSpaceOf(leading);
}

// Estimates whether another factorisation takes fewer multiply-adds than an
// update. An update keeps the columns of all variables that were fixed since
// the last factorisation. If the rows leave no freedom, a factorisation only
// eliminates the later levels. The factors 5, 15 and 3 of an update are the
// passes over T for a direction that is added, for one that is removed, and for
// the check at the end, counted in recorded ticks.
bool DiagonalLevels::IsFactoringFaster(
    const LexicographicFactorization& leading, int added, int removed) const {
  constexpr double kOverhead = kernels::kRowOverhead;
  const int columns = leading.variables().num_free();
  const int rows = leading.rank() - leading.variables().size();
  const int later = std::min(blocks_[0].begin, rows), rest = rows - later;
  const double elimination =
      later * (rows - later / 2.0) * (2 * columns + later + 3 * kOverhead);
  const double orthogonalisation =
      rows == columns ? 0 : 2.0 * rest * rest * (columns - later + kOverhead);
  const double update = (5.0 * added + 15 * removed + 3) * (rank_ + added) *
                        (num_free_ + kOverhead);
  return elimination + orthogonalisation < update;
}

// Returns whether a sum of the rows of T is in the row space of Q, which has
// the same rank. Of a difference by an angle a, such a sum shows nothing with a
// probability of about kSameRowSpace / a. If it shows nothing, y is wrong, and
// its certificate fails.
bool DiagonalLevels::HasRowSpaceOf(const LexicographicFactorization& leading) {
  if (rank_ == num_free_) return true;  // Both are the whole space.
  FindSumOfT(true);
  return !SubtractProjectionOnQ(leading);
}

// Finds direction_, a unit vector in the row space of Q and orthogonal to that
// of T. It returns false if there is none. If a row of Q is not in the row
// space of T, neither is the sum of all rows with factors that are all
// different, except by chance. After AppendDirection(), this sum is in the row
// space of T; so each further direction needs another `power` of the factors.
// Powers of different positive numbers are independent.
bool DiagonalLevels::FindAdded(const LexicographicFactorization& leading,
                               int power) {
  for (int p = 0; p < num_free_; ++p) {
    if (leading.variables().is_fixed(order_[p]) && FindUnit(p)) return true;
  }
  for (int i = 0; i < leading.rank(); ++i) {
    z_[i] = probe_[i];
    for (int k = 1; k < power; ++k) z_[i] *= probe_[i];
  }
  Start(leading, z_.data());
  Count(leading.rank(), num_free_);
  std::copy_n(start_.begin(), num_free_, direction_.begin());
  return Normalize() && SubtractProjectionOnT() && SubtractProjectionOnT();
}

// FindAdded() for the unit vector of position p. Returns false if it depends on
// the rows of T, but for a part below kIndependentPart.
bool DiagonalLevels::FindUnit(int p) {
  double squares = 0;
  for (int i = 0; i < rank_; ++i) {
    const double entry = T(i)[p];
    z_[i] = -entry;
    squares += entry * entry;
  }
  constexpr double kLeast =
      tolerances::kIndependentPart * tolerances::kIndependentPart;
  if (1 - squares < kLeast) return false;
  std::fill_n(direction_.begin(), num_free_, 0);
  direction_[p] = 1;
  AddRows(t_.data(), stride_, rank_, z_.data(), num_free_, direction_.data());
  Count(rank_, num_free_);
  // Where the first projection leaves little, the second one removes its
  // rounding.
  const double length = std::sqrt(1 - squares);
  return Normalize() &&
         (length >= tolerances::kReorthogonalize || SubtractProjectionOnT());
}

// Finds direction_, a unit vector in the row space of T and orthogonal to that
// of Q. It returns false if there is none.
bool DiagonalLevels::FindRemoved(const LexicographicFactorization& leading) {
  FindSumOfT(false);
  return SubtractProjectionOnQ(leading) && SubtractProjectionOnQ(leading);
}

// Computes direction_ as a sum of the rows of T, of unit length. The signs of
// the factors alternate: T may have rows of Q, and FindAdded() has put the sum
// of the rows of Q into both row spaces.
void DiagonalLevels::FindSumOfT(bool is_reversed) {
  for (int i = 0; i < rank_; ++i) {
    const double factor = probe_[is_reversed ? n_ - 1 - i : i];
    z_[i] = i % 2 == 0 ? factor : -factor;
  }
  std::fill(direction_.begin(), direction_.end(), 0);
  AddRows(t_.data(), stride_, rank_, z_.data(), num_free_, direction_.data());
  Count(rank_, num_free_);
  Normalize();
}

// Subtracts the projection on the rows of T from direction_, and divides it by
// its length. Returns false if this is rounding.
bool DiagonalLevels::SubtractProjectionOnT() {
  Dots(t_.data(), stride_, rank_, direction_.data(), num_free_, z_.data());
  for (int i = 0; i < rank_; ++i) z_[i] = -z_[i];
  AddRows(t_.data(), stride_, rank_, z_.data(), num_free_, direction_.data());
  Count(2 * rank_, num_free_);
  return Normalize();
}

// SubtractProjectionOnT() for the rows of Q.
bool DiagonalLevels::SubtractProjectionOnQ(
    const LexicographicFactorization& leading) {
  Project(leading, direction_.data(), z_.data());
  Start(leading, z_.data());
  Count(leading.rank(), num_free_);
  for (int p = 0; p < num_free_; ++p) direction_[p] -= start_[p];
  return Normalize();
}

// Divides direction_ by its length. Returns false if it is rounding.
bool DiagonalLevels::Normalize() {
  const double length = std::sqrt(SquaredNorm(direction_.data(), num_free_));
  if (length <= tolerances::kSameRowSpace) return false;
  kernels::Scale(direction_.data(), 1 / length, num_free_, direction_.data());
  return true;
}

// Adds a column and a unit row for a variable that is no longer fixed. If its
// unit vector is not in the row space of Q, UpdateFactors() removes a direction
// afterwards. Returns false if the variable is not of the first level, whose
// columns come last. A variable of unusual weight takes the place of the first
// one of the usual weight, which moves to the end.
bool DiagonalLevels::Release(int p) {
  Block& first = blocks_[0];
  const int variable = order_[p];
  if (level_of_[variable] != 0) return false;
  const int end = num_free_++, row = rank_++;
  const bool is_unusual =
      usual_begin_ < end && weight_[variable] != weight_[order_[usual_begin_]];
  const int position = is_unusual ? usual_begin_++ : end;
  order_[p] = order_[end];
  order_[end] = order_[position];
  order_[position] = variable;
  for (const int at : {p, end, position}) SetScale(at);
  InsertUnit(0, row, position, end, t_.data());
  if (!IsSquare()) {
    InsertUnit(first.row_begin, row, position - first.begin, end - first.begin,
               q_.data());
    std::fill_n(L(row), row - first.row_begin, 0);
    L(row)[row - first.row_begin] = 1 / scale_[position];
  }
  ++first.end;
  ++first.row_end;
  return true;
}

// Moves a column of the rows from `first` on to `end`. The row `added` gets its
// only entry in the column that is now zero.
void DiagonalLevels::InsertUnit(int first, int added, int column, int end,
                                double* rows) {
  for (int i = first; i < added; ++i) {
    double* entries = rows + Index(i);
    entries[end] = entries[column];
    entries[column] = 0;
  }
  std::fill_n(rows + Index(added), end + 1, 0);
  rows[Index(added) + column] = 1;
}

// Returns whether T_cc is square for all levels but the first.
bool DiagonalLevels::HasSquareLaterLevels() const {
  for (int level = 1; level < num_levels_; ++level) {
    const Block& block = blocks_[level];
    if (block.row_end - block.row_begin != block.end - block.begin) {
      return false;
    }
  }
  return true;
}

// Appends direction_, which is orthogonal to the rows of T. The rows of the
// later levels eliminate its columns of these levels. The rest is a row of
// T_00.
bool DiagonalLevels::AppendDirection() {
  if (rank_ == num_free_) return false;
  Block& first = blocks_[0];
  double* added = T(rank_);
  std::copy_n(direction_.data(), num_free_, added);
  for (int i = 0; i < first.row_begin; ++i) {
    double* row = T(i);
    const int pivot = pivot_[i];
    const double length = kernels::Length(row[pivot], added[pivot]);
    Rotate(row[pivot] / length, added[pivot] / length, num_free_, row, added);
    added[pivot] = 0;
  }
  Count(4 * first.row_begin, num_free_);
  std::fill_n(added, first.begin, 0);
  ++rank_;
  ++first.row_end;
  for (int level = 1; level < num_levels_; ++level) FactorLevel(level);
  return IsSquare() || FactorRow(0, rank_ - 1) >= tolerances::kIndependentPart;
}

// Removes direction_, which is in the row space of T. With u = T direction,
// rotations of neighbouring rows of T_00 make u zero but in the last of these
// rows. Rotations with the rows of the later levels, from the last to the
// first, then make this row direction_ itself, and it is dropped.
bool DiagonalLevels::RemoveDirection() {
  Block& first = blocks_[0];
  // Without freedom, T_00 has no factors that could be updated.
  if (first.row_begin == first.row_end || IsSquare()) return false;
  double* u = z_.data();
  Dots(t_.data(), stride_, rank_, direction_.data(), num_free_, u);
  Count(rank_, num_free_);
  for (int row = first.row_begin; row + 1 < rank_; ++row) {
    const double length = kernels::Length(u[row], u[row + 1]);
    if (length == 0) continue;
    const double c = u[row + 1] / length, s = u[row] / length;
    u[row + 1] = length;
    double* t = T(row) + first.begin;
    Rotate(c, s, first.end - first.begin, t + stride_, t);
    Count(4, first.end - first.begin);
    RotateFactor(row, c, s);
  }
  --rank_;
  --first.row_end;
  double* moved = T(rank_);
  double on_moved = u[rank_];
  for (int i = first.row_begin - 1; i >= 0; --i) {
    double* row = T(i);
    const double length = kernels::Length(u[i], on_moved);
    const double c = length > 0 ? u[i] / length : 0;
    const double s = length > 0 ? on_moved / length : 1;
    Rotate(c, s, num_free_, row, moved);
    std::swap_ranges(row, row + num_free_, moved);
    on_moved = length;
    if (std::abs(row[pivot_[i]]) < tolerances::kIndependentPart) return false;
  }
  Count(5 * first.row_begin, num_free_);
  usual_row_end_ = std::max(first.row_begin, usual_row_end_ - 1);
  for (int level = 1; level < num_levels_; ++level) FactorLevel(level);
  return true;
}

// Rotates the rows `row` and row + 1 of L: (next, this) = (c next + s this, c
// this - s next). Row `row` then has one entry too many. A rotation of two
// columns of L, and of two rows of its Q, eliminates it.
void DiagonalLevels::RotateFactor(int row, double c, double s) {
  const Block& first = blocks_[0];
  const int i = row - first.row_begin, columns = first.end - first.begin;
  double *l = L(row), *next = L(row + 1);
  Rotate(c, s, i + 1, next, l);
  const double beyond = -s * next[i + 1];
  next[i + 1] *= c;
  const double diagonal = kernels::Length(l[i], beyond);
  if (diagonal == 0) return;
  const double cosine = l[i] / diagonal, sine = beyond / diagonal;
  l[i] = diagonal;
  for (int k = row + 1; k < first.row_end; ++k) {
    kernels::RotatePair(cosine, sine, L(k) + i);
  }
  double* q = Q(row);
  Rotate(cosine, sine, columns, q, q + stride_);
  Count(4, columns);
}

}  // namespace poise
