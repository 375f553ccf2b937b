// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/hierarchy.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

namespace poise {
namespace {

LevelCapacity Sum(const std::vector<LevelCapacity>& capacity) {
  LevelCapacity sum;
  for (const LevelCapacity& level : capacity) {
    sum.equalities += level.equalities;
    sum.inequalities += level.inequalities;
  }
  return sum;
}

// Returns whether four entries are zero, of either sign: the first bit is the
// sign.
bool AreFourZeros(const double* x) {
  std::uint64_t bits[4];
  std::memcpy(bits, x, sizeof(bits));
  return ((bits[0] | bits[1]) | (bits[2] | bits[3])) << 1 == 0;
}

// Shortens a span of all n columns to the nonzero entries of a row. NaN counts
// as nonzero.
void FindSpan(const double* row, int n, Span* span) {
  if (span->size < n) {
    assert(std::all_of(row, row + span->first,
                       [](double entry) { return entry == 0; }));
    assert(std::all_of(row + span->first + span->size, row + n,
                       [](double entry) { return entry == 0; }));
    return;
  }
  int first = 0, end = n;
  while (first + 4 <= n && AreFourZeros(row + first)) first += 4;
  while (first < n && row[first] == 0) ++first;
  while (end - 4 >= first && AreFourZeros(row + end - 4)) end -= 4;
  while (end > first && row[end - 1] == 0) --end;
  *span = {first, end - first};
}

}  // namespace

int NumRows(const std::vector<LevelCapacity>& capacity) {
  const LevelCapacity sum = Sum(capacity);
  return sum.equalities + sum.inequalities;
}

Hierarchy::Hierarchy(int num_variables,
                     const std::vector<LevelCapacity>& capacity)
    : Hierarchy(num_variables, capacity, Sum(capacity)) {}

Hierarchy::Hierarchy(int num_variables,
                     const std::vector<LevelCapacity>& capacity,
                     const LevelCapacity& total)
    : num_variables_(num_variables),
      capacity_(capacity),
      levels_(capacity.size()) {
  if (num_variables < 0) {
    throw std::invalid_argument("hierarchy: the number of variables is " +
                                std::to_string(num_variables) +
                                ", must not be negative");
  }
  for (size_t level = 0; level < capacity.size(); ++level) {
    if (capacity[level].equalities < 0 || capacity[level].inequalities < 0) {
      throw std::invalid_argument(
          "hierarchy: level " + std::to_string(level) +
          " has a negative number of rows, must be 0 or more");
    }
  }
  if (total.equalities < 0 || total.inequalities < 0) {
    throw std::invalid_argument(
        "hierarchy: the total number of rows is negative, must be 0 or more");
  }
  B_.resize(Size(total.equalities));
  b_.setZero(total.equalities);
  weight_.setOnes(total.equalities);
  C_.resize(Size(total.inequalities));
  lower_.setZero(total.inequalities);
  upper_.setZero(total.inequalities);
  B_span_.resize(total.equalities);
  C_span_.resize(total.inequalities);
  const LevelCapacity sum = Sum(capacity);
  const bool all_fit = sum.equalities <= total.equalities &&
                       sum.inequalities <= total.inequalities;
  const std::vector<LevelCapacity> none(capacity.size());
  Clear(static_cast<int>(capacity.size()),
        all_fit ? capacity.data() : none.data());
}

void Hierarchy::Clear(int num_levels) noexcept {
  Clear(num_levels, capacity_.data());
}

void Hierarchy::Clear(int num_levels, const LevelCapacity* rows) noexcept {
  assert(num_levels >= 0 && num_levels <= static_cast<int>(levels_.size()));
  used_levels_ = num_levels;
  std::fill(levels_.begin(), levels_.end(), Level{});
  LevelCapacity sum;
  for (int level = 0; level < num_levels; ++level) {
    levels_[level].first_equality = sum.equalities;
    levels_[level].first_inequality = sum.inequalities;
    levels_[level].most = rows[level];
    sum.equalities += rows[level].equalities;
    sum.inequalities += rows[level].inequalities;
  }
  assert(sum.equalities <= b_.size() && sum.inequalities <= lower_.size());
}

EqualityBlock Hierarchy::AddEqualities(int level, int rows) noexcept {
  assert(level >= 0 && level < used_levels_ && rows >= 0);
  Level& to = levels_[level];
  assert(to.equalities + rows <= to.most.equalities);
  const int first = to.first_equality + to.equalities;
  to.equalities += rows;
  double* B = B_.data() + Size(first);
  std::fill_n(B, Size(rows), 0);
  b_.segment(first, rows).setZero();
  weight_.segment(first, rows).setOnes();
  std::fill_n(B_span_.begin() + first, rows, Span{0, num_variables_});
  return {{B, rows, num_variables_},
          {b_.data() + first, rows},
          {weight_.data() + first, rows},
          B_span_.data() + first};
}

InequalityBlock Hierarchy::AddInequalities(int level, int rows) noexcept {
  assert(level >= 0 && level < used_levels_ && rows >= 0);
  Level& to = levels_[level];
  assert(to.inequalities + rows <= to.most.inequalities);
  const int first = to.first_inequality + to.inequalities;
  to.inequalities += rows;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double* C = C_.data() + Size(first);
  std::fill_n(C, Size(rows), 0);
  lower_.segment(first, rows).setConstant(-kInfinity);
  upper_.segment(first, rows).setConstant(kInfinity);
  std::fill_n(C_span_.begin() + first, rows, Span{0, num_variables_});
  return {{C, rows, num_variables_},
          {lower_.data() + first, rows},
          {upper_.data() + first, rows},
          C_span_.data() + first};
}

void Hierarchy::FindSpans() noexcept {
  for (int k = 0; k < used_levels_; ++k) {
    const Level& level = levels_[k];
    for (int i = 0; i < level.equalities; ++i) {
      const int row = level.first_equality + i;
      FindSpan(B_.data() + Size(row), num_variables_, &B_span_[row]);
    }
    for (int i = 0; i < level.inequalities; ++i) {
      const int row = level.first_inequality + i;
      FindSpan(C_.data() + Size(row), num_variables_, &C_span_[row]);
    }
  }
}

}  // namespace poise
