// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/math/spatial.h"

namespace poise {

/// How the links of a random tree hang together.
enum class TreeShape { kAny, kChain, kStar };

/// What a random tree is made from; fewer joints are tried when a case fails.
struct TreeCase {
  TreeShape shape;
  BaseType base;
  int num_joints;
  int seed;
};

/// A tree of any kind, and a motion of it. Joints of all types, about any axes,
/// some with armatures; massless links inside; fixed links that carry joints,
/// and one joint locked in each tree that has three; gravity askew. Its M is
/// positive definite: no massless links at the ends, nor two in a row.
struct TreeMotion {
  Tree tree;
  Eigen::VectorXd q, v, vdot;
  std::vector<SpatialForce>
      F_Bo_W;  ///< A force on each body, see ComputeRnea().
};

TreeMotion MakeTreeMotion(const TreeCase& from);

/// What a property compares: it holds if value <= tolerance.
struct Residual {
  double value;
  double tolerance;
};

/// The largest difference of two matrices, to be within a tolerance.
Residual Compare(const Eigen::Ref<const Eigen::MatrixXd>& A,
                 const Eigen::Ref<const Eigen::MatrixXd>& B, double tolerance);

/// Tries a property on random trees by RapidCheck, a failure of which prints the
/// case and how to reproduce it. Returns whether it holds: EXPECT_TRUE() it.
bool HoldsForTrees(
    const std::string& property,
    const std::function<Residual(const TreeMotion&)>& residual_of,
    int max_joints = 14);

}  // namespace poise
