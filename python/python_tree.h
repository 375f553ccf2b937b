// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

#include "poise/dynamics/aba.h"
#include "poise/dynamics/recursion.h"
#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"
#include "poise/math/spatial.h"

namespace poise {

/// A tree with the scratch memory of the algorithms. Python holds its global
/// lock (GIL) while an algorithm uses this memory. An algorithm that releases
/// the lock has memory of its own.
class PythonTree {
 public:
  /// @param tree  keeps its owner alive.
  explicit PythonTree(std::shared_ptr<const Tree> tree)
      : tree_(std::move(tree)),
        recursion(*tree_),
        aba(*tree_),
        X_WB(tree_->num_bodies()),
        V_WB_W(tree_->num_bodies()),
        A_WB_W(tree_->num_bodies()) {}

  const Tree& tree() const { return *tree_; }

  /// Returns the index of a frame, given by its name or its index. Throws
  /// std::invalid_argument if there is no such frame.
  int FindFrame(pybind11::handle frame) const;

 private:
  std::shared_ptr<const Tree> tree_;

 public:
  Recursion recursion;
  AbaScratch aba;
  std::vector<Pose> X_WB;
  std::vector<SpatialMotion> V_WB_W;
  std::vector<SpatialAcceleration> A_WB_W;
};

}  // namespace poise
