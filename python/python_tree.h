// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <type_traits>
#include <vector>

#include "poise/dynamics/aba.h"
#include "poise/dynamics/recursion.h"
#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"
#include "poise/math/spatial.h"

namespace poise {

/// The scratch memory of the kinematics.
struct KinematicsScratch {
  explicit KinematicsScratch(const Tree& tree)
      : X_WB(tree.num_bodies()),
        V_WB_W(tree.num_bodies()),
        A_WB_W(tree.num_bodies()) {}

  std::vector<Pose> X_WB;
  std::vector<SpatialMotion> V_WB_W;
  std::vector<SpatialAcceleration> A_WB_W;
};

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
        kinematics(*tree_) {}

  const Tree& tree() const { return *tree_; }

  /// Returns the index of a frame, given by its name or its index. Throws
  /// std::invalid_argument if there is no such frame.
  int FindFrame(pybind11::handle frame) const;

  /// Returns whether an algorithm may take more than 10 us with this tree, so
  /// that it should release the lock. For 50 joints, ABA takes 7 to 12 us, by
  /// the machine, the others at most 6 us.
  /// @tparam Scratch  the memory of the algorithm.
  template <typename Scratch>
  bool IsLong() const {
    constexpr int kMostBodies = std::is_same_v<Scratch, AbaScratch> ? 30 : 60;
    return tree_->num_bodies() > kMostBodies;
  }

  /// Calls compute(scratch memory). If that may take more than 10 us, releases
  /// the lock meanwhile: compute() must not use Python.
  /// @param scratch  a member of this class.
  template <typename Scratch, typename Compute>
  auto Run(Scratch PythonTree::*scratch, const Compute& compute) {
    if (!IsLong<Scratch>()) return compute(&(this->*scratch));
    const pybind11::gil_scoped_release release;
    Scratch own(*tree_);
    return compute(&own);
  }

 private:
  std::shared_ptr<const Tree> tree_;

 public:
  Recursion recursion;
  AbaScratch aba;
  KinematicsScratch kinematics;
};

}  // namespace poise
