// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/math/vector6.h"
#include "poise/robot/control/contacts.h"
#include "poise/robot/robot.h"

namespace poise {

/// Relative motions of two feet A and B that the joints between them cannot
/// make, or only by large joint motions.
struct LockedMotions {
  int count = 0;
  /// The first `count` columns n: n' [V_WA_A; V_WB_B] is zero or small whatever
  /// the robot does. n' metric n = 1, and different columns are orthogonal.
  Eigen::Matrix<double, 12, 6> n;
  /// By column, above 0 and at most 1: how far the motion is locked.
  Vector6d share;
  /// Diagonal of the metric: 1/L2 for rotations, 1 for translations.
  Eigen::Matrix<double, 12, 1> metric;
};

/// Computes the rank of the kinematic loop that two feet on the ground close.
/// A leg of six joints can move its foot in all directions. Two legs of four or
/// five joints cannot: the rows of both contacts are then dependent, or nearly
/// so, and the base would move by 1/sigma times any disagreement of them.
///
/// The columns of R = X_BA J_WA_A - J_WB_B, over the joints that move one foot
/// and not the other, are the motions of A relative to B. Rotations are
/// multiplied by the length L that makes both halves of R equally large. A
/// direction is locked if its singular value is below kLeast times the
/// Frobenius norm of R; its share grows to 1 at a third of that.
class LoopClosure {
 public:
  static constexpr double kLeast = 1e-2;

  /// @param a, b  bodies of the two feet, indices into the tree.
  LoopClosure(const RobotModel& model, int a, int b);

  /// Finds the locked motions at the posture of this tick. Cost: 1 us if there
  /// are none. Does not allocate.
  void FindLocked(const ContactTick& a, const ContactTick& b,
                  LockedMotions* locked) const noexcept;

 private:
  // A joint and those that are coupled to it: indices into v, and factors.
  struct Column {
    std::vector<int> joints;
    std::vector<double> factors;
  };

  std::vector<Column> columns_;
};

/// Returns the indices of the joints between the base and a body, the one next
/// to the body first. Allocates.
std::vector<int> JointsTo(const Tree& tree, int body);

}  // namespace poise
