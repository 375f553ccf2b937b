// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/hierarchy.h"

#include <cassert>
#include <limits>
#include <stdexcept>
#include <string>

namespace poise {

int NumRows(const std::vector<LevelCapacity>& capacity) {
  int rows = 0;
  for (const LevelCapacity& level : capacity) {
    rows += level.equalities + level.inequalities;
  }
  return rows;
}

Hierarchy::Hierarchy(int num_variables,
                     const std::vector<LevelCapacity>& capacity)
    : num_variables_(num_variables),
      used_levels_(static_cast<int>(capacity.size())) {
  if (num_variables < 0) {
    throw std::invalid_argument("hierarchy: the number of variables is " +
                                std::to_string(num_variables) +
                                ", must not be negative");
  }
  for (const LevelCapacity& rows : capacity) {
    if (rows.equalities < 0 || rows.inequalities < 0) {
      throw std::invalid_argument(
          "hierarchy: level " + std::to_string(levels_.size()) +
          " has a negative number of rows, must be 0 or more");
    }
    Level level;
    level.B.setZero(rows.equalities, num_variables);
    level.b.setZero(rows.equalities);
    level.weight.setOnes(rows.equalities);
    level.C.setZero(rows.inequalities, num_variables);
    level.lower.setZero(rows.inequalities);
    level.upper.setZero(rows.inequalities);
    levels_.push_back(std::move(level));
  }
}

void Hierarchy::Clear(int num_levels) noexcept {
  assert(num_levels >= 0 && num_levels <= static_cast<int>(levels_.size()));
  used_levels_ = num_levels;
  for (Level& level : levels_) {
    level.equalities = 0;
    level.inequalities = 0;
  }
}

EqualityBlock Hierarchy::AddEqualities(int level, int rows) noexcept {
  assert(level >= 0 && level < used_levels_ && rows >= 0);
  Level& to = levels_[level];
  assert(to.equalities + rows <= to.b.size());
  const int first = to.equalities;
  to.equalities += rows;
  to.B.middleRows(first, rows).setZero();
  to.b.segment(first, rows).setZero();
  to.weight.segment(first, rows).setOnes();
  return {{to.B.data() + first * to.B.cols(), rows, to.B.cols()},
          {to.b.data() + first, rows},
          {to.weight.data() + first, rows}};
}

InequalityBlock Hierarchy::AddInequalities(int level, int rows) noexcept {
  assert(level >= 0 && level < used_levels_ && rows >= 0);
  Level& to = levels_[level];
  assert(to.inequalities + rows <= to.lower.size());
  const int first = to.inequalities;
  to.inequalities += rows;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  to.C.middleRows(first, rows).setZero();
  to.lower.segment(first, rows).setConstant(-kInfinity);
  to.upper.segment(first, rows).setConstant(kInfinity);
  return {{to.C.data() + first * to.C.cols(), rows, to.C.cols()},
          {to.lower.data() + first, rows},
          {to.upper.data() + first, rows}};
}

int Hierarchy::num_equalities(int level) const {
  return levels_[level].equalities;
}

int Hierarchy::num_inequalities(int level) const {
  return levels_[level].inequalities;
}

Eigen::Map<const RowMajorMatrix> Hierarchy::B(int level) const {
  const Level& from = levels_[level];
  return {from.B.data(), from.equalities, num_variables_};
}

Eigen::Map<const Eigen::VectorXd> Hierarchy::b(int level) const {
  return {levels_[level].b.data(), levels_[level].equalities};
}

Eigen::Map<const Eigen::VectorXd> Hierarchy::weight(int level) const {
  return {levels_[level].weight.data(), levels_[level].equalities};
}

Eigen::Map<const RowMajorMatrix> Hierarchy::C(int level) const {
  const Level& from = levels_[level];
  return {from.C.data(), from.inequalities, num_variables_};
}

Eigen::Map<const Eigen::VectorXd> Hierarchy::lower(int level) const {
  return {levels_[level].lower.data(), levels_[level].inequalities};
}

Eigen::Map<const Eigen::VectorXd> Hierarchy::upper(int level) const {
  return {levels_[level].upper.data(), levels_[level].inequalities};
}

}  // namespace poise
