// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "hqp/hierarchy.h"
#include "hqp/solution.h"

namespace poise {

/// The paper's algorithm, literally: a cascade of QPs (5), (6), each in the
/// nullspace (3) that the levels above leave, found by an SVD. The reference:
/// readable, not fast.
class Cascade {
 public:
  Cascade(int num_variables, const std::vector<LevelCapacity>& capacity);

  [[nodiscard]] Status Solve(const Hierarchy& hierarchy,
                             Solution* solution) noexcept;
};

}  // namespace poise
