// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/peers/bounded_rows.h"

#include <algorithm>
#include <cmath>

namespace poise {
namespace {

void Append(const Eigen::RowVectorXd& row, double lower, double upper,
            int source, BoundedRows* to) {
  const int i = to->rows();
  to->A.row(i) = row;
  to->lower[i] = lower;
  to->upper[i] = upper;
  to->source.push_back(source);
}

BoundedRows ToBoundedRows(const Hierarchy& hierarchy, int k) {
  const int most = hierarchy.num_equalities(k) + hierarchy.num_inequalities(k);
  BoundedRows level;
  level.A.resize(most, hierarchy.num_variables());
  level.lower.resize(most);
  level.upper.resize(most);
  for (int i = 0; i < hierarchy.num_equalities(k); ++i) {
    const double root = std::sqrt(hierarchy.weight(k)[i]);
    if (root == 0 || hierarchy.B(k).row(i).isZero(0)) continue;
    const double value = -root * hierarchy.b(k)[i];
    Append(root * hierarchy.B(k).row(i), value, value, -1, &level);
  }
  for (int i = 0; i < hierarchy.num_inequalities(k); ++i) {
    const double lower = hierarchy.lower(k)[i], upper = hierarchy.upper(k)[i];
    const bool has_bound = std::isfinite(lower) || std::isfinite(upper);
    if (!has_bound || hierarchy.C(k).row(i).isZero(0)) continue;
    Append(hierarchy.C(k).row(i), lower, upper, i, &level);
  }
  level.A.conservativeResize(level.rows(), Eigen::NoChange);
  level.lower.conservativeResize(level.rows());
  level.upper.conservativeResize(level.rows());
  return level;
}

}  // namespace

std::vector<BoundedRows> ToBoundedRows(const Hierarchy& hierarchy,
                                       std::vector<int>* levels) {
  std::vector<BoundedRows> problem;
  levels->clear();
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    BoundedRows level = ToBoundedRows(hierarchy, k);
    if (level.rows() == 0) continue;
    problem.push_back(std::move(level));
    levels->push_back(k);
  }
  return problem;
}

ActiveSides NoActiveSides(const std::vector<LevelCapacity>& capacity) {
  ActiveSides sides;
  for (const LevelCapacity& level : capacity) {
    sides.emplace_back(level.inequalities, Side::kNone);
  }
  return sides;
}

void Deactivate(ActiveSides* sides) {
  for (std::vector<Side>& level : *sides) {
    std::fill(level.begin(), level.end(), Side::kNone);
  }
}

bool HaveSameSizes(const std::vector<BoundedRows>& a,
                   const std::vector<BoundedRows>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const BoundedRows& x, const BoundedRows& y) {
                      return x.rows() == y.rows();
                    });
}

}  // namespace poise
