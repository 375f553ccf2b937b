// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "poise/hqp/hierarchy.h"

namespace poise {

/// A hierarchical solver in the comparison. One object solves consecutive
/// ticks.
class Peer {
 public:
  virtual ~Peer() = default;

  /// Copies the problem into the solver's own format. This step is not timed.
  virtual void Load(const Hierarchy& hierarchy) = 0;

  /// Solves the loaded problem, starting from the active rows of the last
  /// tick. This step is timed; it contains all that the next warm start needs.
  /// Returns whether the solver reports a solution.
  virtual bool Solve() = 0;

  /// Forgets all earlier solves. The next solve is cold: it starts without
  /// active rows.
  virtual void Forget() = 0;

  /// Allows as many iterations as a problem outside a control loop may take.
  virtual void AllowMoreIterations() {}

  /// Returns the last answer, or the last iterate of a solve that failed.
  virtual const Eigen::VectorXd& y() const = 0;
};

/// Makes the solver that this program is built with. Each adapter defines it.
std::unique_ptr<Peer> MakePeer(int num_variables,
                               const std::vector<LevelCapacity>& capacity);

}  // namespace poise
