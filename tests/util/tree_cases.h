// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/math/spatial.h"

namespace poise {

/// Shape of a random tree.
enum class TreeShape { kAny, kChain, kStar };

/// Parameters of a random tree. When a case fails, RapidCheck tries fewer
/// joints.
struct TreeCase {
  TreeShape shape;
  BaseType base;
  int num_joints;
  int seed;
};

/// A random tree and a motion of it. The tree has:
/// - joints of all types about any axes, some with armatures;
/// - massless links, but neither at an end nor two in a row;
/// - fixed links that carry joints;
/// - one locked joint, if there are at least three;
/// - gravity in any direction.
///
/// Its mass matrix M is positive definite.
struct TreeMotion {
  Tree tree;
  Eigen::VectorXd q, v, vdot;
  std::vector<SpatialForce>
      F_Bo_W;  ///< A force on each body, see ComputeRnea().
};

TreeMotion MakeTreeMotion(const TreeCase& from);

/// Residual of a property, which holds if value <= tolerance.
struct Residual {
  double value;
  double tolerance;
};

/// Returns the largest difference of two matrices, and its tolerance.
Residual Compare(const Eigen::Ref<const Eigen::MatrixXd>& A,
                 const Eigen::Ref<const Eigen::MatrixXd>& B, double tolerance);

/// Checks a property on random trees with RapidCheck. A failure prints the case
/// and how to reproduce it. Returns whether the property holds, for
/// EXPECT_TRUE().
bool HoldsForTrees(
    const std::string& property,
    const std::function<Residual(const TreeMotion&)>& residual_of,
    int max_joints = 14);

}  // namespace poise
