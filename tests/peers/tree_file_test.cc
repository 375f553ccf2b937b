// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/peers/tree_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>

#include "poise/dynamics/rnea.h"
#include "poise/tests/util/random_tree.h"

namespace poise {
namespace {

// Returns the torques of a random motion. They depend on each number of the
// tree but the frames'.
Eigen::VectorXd Torques(const Tree& tree) {
  std::mt19937 draw(3);
  const Eigen::VectorXd q = MakeRandomConfiguration(tree, &draw);
  const Eigen::VectorXd v = MakeRandomVector(tree.nv(), &draw);
  Recursion scratch(tree);
  Eigen::VectorXd tau(tree.nv());
  ComputeRnea(tree, q, v, v, {}, &scratch, tau);
  return tau;
}

TEST(TreeFile, KeepsTheRobot) {
  for (const BaseType base : {BaseType::kFloating, BaseType::kFixed}) {
    std::mt19937 draw(7);
    const Tree tree = MakeRandomTree(9, &draw, base, {1, 2, -9});
    const std::string path = testing::TempDir() + "/tree";
    WriteTree(tree, path);
    const Tree read = ReadTree(path);
    ASSERT_EQ(read.num_joints(), tree.num_joints());
    for (int j = 0; j < tree.num_joints(); ++j) {
      EXPECT_EQ(read.joints()[j].name, tree.joints()[j].name);
    }
    for (const Frame& frame : tree.frames()) {
      const auto i = read.FindFrame(frame.name);
      ASSERT_TRUE(i.has_value()) << frame.name;
      EXPECT_EQ(read.frames()[*i].body, frame.body);
      EXPECT_EQ(read.frames()[*i].X_BF.p, frame.X_BF.p);
      // The builder may change the last bit of a rotation.
      EXPECT_LT((read.frames()[*i].X_BF.R - frame.X_BF.R).norm(), 1e-15);
    }
    // The builder may normalise axes and rotations once more: each such entry
    // changes by an eps, and a torque sums up about 100 terms.
    const Eigen::VectorXd tau = Torques(tree);
    EXPECT_LT((Torques(read) - tau).norm(), 1e-13 * tau.norm());
  }
}

TEST(TreeFile, RejectsOtherFiles) {
  std::mt19937 draw(7);
  const std::string path = testing::TempDir() + "/short_tree";
  WriteTree(MakeRandomTree(3, &draw), path);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_THROW(ReadTree(path), std::invalid_argument);
  EXPECT_THROW(ReadTree(testing::TempDir() + "/missing"),
               std::invalid_argument);
}

}  // namespace
}  // namespace poise
