// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/hierarchy_by_hand.h"

#include <Eigen/Core>
#include <algorithm>

namespace poise {
namespace {

std::vector<LevelCapacity> Capacity(const std::vector<RowByHand>& rows) {
  std::vector<LevelCapacity> capacity;
  for (const RowByHand& row : rows) {
    capacity.resize(std::max<size_t>(capacity.size(), row.level + 1));
    ++(row.lower == row.upper ? capacity[row.level].equalities
                              : capacity[row.level].inequalities);
  }
  return capacity;
}

}  // namespace

HierarchyByHand::HierarchyByHand(int num_variables,
                                 const std::vector<RowByHand>& rows)
    : capacity(Capacity(rows)), hierarchy(num_variables, capacity) {
  for (const RowByHand& from : rows) {
    const auto row = Eigen::RowVectorXd::Map(from.row.data(), num_variables);
    if (from.lower == from.upper) {
      EqualityBlock to = hierarchy.AddEqualities(from.level, 1);
      to.B = row;
      to.b[0] = -from.lower;
      continue;
    }
    InequalityBlock to = hierarchy.AddInequalities(from.level, 1);
    to.C = row;
    to.lower[0] = from.lower;
    to.upper[0] = from.upper;
  }
}

}  // namespace poise
