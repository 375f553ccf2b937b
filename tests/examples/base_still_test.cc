// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests the example of docs/tasks.md: the task works, and the page quotes the
// files that are built here.
#include "poise/tests/examples/base_still.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"
#include "poise/hqp/solver.h"
#include "poise/robot/control/default_stack.h"
#include "poise/robot/control/stack.h"
#include "poise/robot/control/task_set.h"
#include "poise/robot/control/tasks/task_fixture.h"

namespace poise {
namespace {

constexpr bool kOff = false;

TEST_F(TaskTest, BaseStillBrakesARotation) {
  const BaseStillTask task;
  Eigen::VectorXd y = RandomY();
  y.head<3>() = -10 * state_.v.head<3>();
  EXPECT_LT(Residual(task, y).norm(), 1e-12);
  y.head<3>() *= -1;  // This acceleration speeds it up.
  EXPECT_GT(Residual(task, y).norm(), 10 * state_.v.head<3>().norm());
}

class BaseStillTest : public TaskTest {
 protected:
  BaseStillTest() : stack_(MakeDefaultStack(robot_, {})) {
    Stack& stack = stack_;
    if (stack.Find("base_still")) return;  // Added by a reader of the page.
    stack.Add(std::make_unique<BaseStillTask>(), {kOff, 4, 1});
  }

  Eigen::Vector3d SolvedAcceleration() {
    const int size = nv_ + 12;
    Hierarchy hierarchy(size, stack_.capacity());
    Solver solver(size, stack_.capacity());
    Solution solution(size, stack_.capacity());
    stack_.Write(input(), &hierarchy);
    EXPECT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
    return solution.y.head<3>();
  }

  // The solver's tolerance: 1e-9 of a target that is below 10 rad/s2.
  static constexpr double kSolved = 1e-8;
  Stack stack_;
};

TEST_F(BaseStillTest, IsEnabledByNameBetweenTwoTicks) {
  const Eigen::Vector3d wanted = -5 * state_.v.head<3>();
  EXPECT_GT((SolvedAcceleration() - wanted).norm(), 0.1);
  Stack& stack = stack_;
  const bool is_done = stack.Enable("base_still", true) &&
                       stack.SetLevel("base_still", 3) &&
                       stack.SetParameter("base_still", "kd", 5);
  EXPECT_TRUE(is_done);
  EXPECT_LT((SolvedAcceleration() - wanted).norm(), kSolved);
}

TEST_F(BaseStillTest, IsEnabledByATaskSet) {
  ApplyTaskSet("tests/examples/base_still.yaml", &stack_);
  const Eigen::Vector3d wanted = -5 * state_.v.head<3>();
  EXPECT_LT((SolvedAcceleration() - wanted).norm(), kSolved);
}

TEST_F(BaseStillTest, DescribesItsRows) {
  std::vector<std::string> described;
  for (const auto& [task, row] : stack_.DescribeRows()) {
    if (task != "base_still") continue;
    described.push_back(row.name + " [" + row.unit + "] " + row.phrase);
  }
  EXPECT_EQ(described,
            (std::vector<std::string>{
                "base_still.x [rad/s2] the rotation of the base about x",
                "base_still.y [rad/s2] the rotation of the base about y",
                "base_still.z [rad/s2] the rotation of the base about z"}));
}

std::string Read(const std::string& file) {
  std::ifstream stream(file);
  EXPECT_TRUE(stream) << file;
  return {std::istreambuf_iterator<char>(stream), {}};
}

void Replace(const std::string& from, const std::string& to,
             std::string* text) {
  for (size_t at = 0; (at = text->find(from, at)) != std::string::npos;) {
    text->replace(at, from.size(), to);
    at += to.size();
  }
}

std::string Unindented(const std::string& text) {
  std::string lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines += line.substr(std::min(line.find_first_not_of(' '), line.size()));
    lines += '\n';
  }
  return lines;
}

// Each code block of the page must be part of the files built here, so that
// copied code compiles and works. Only folders and indentation may differ.
TEST(TasksPage, QuotesTheBuiltFiles) {
  std::string built;
  for (const char* name : {"base_still.h", "base_still.cc", "base_still.yaml",
                           "base_still_test.cc", "BUILD"}) {
    built += Read("tests/examples/" + std::string(name));
  }
  Replace("tests/examples/", "robot/control/tasks/", &built);
  built = Unindented(built);
  const std::string page = Unindented(Read("docs/tasks.md"));
  int blocks = 0;
  const std::string fence = "```";
  for (size_t at = 0; (at = page.find(fence, at)) != std::string::npos;) {
    const size_t begin = page.find('\n', at) + 1;
    const size_t end = page.find(fence, begin);
    ASSERT_NE(end, std::string::npos);
    const std::string block = page.substr(begin, end - begin);
    EXPECT_NE(built.find(block), std::string::npos) << block;
    at = end + fence.size();
    ++blocks;
  }
  EXPECT_GE(blocks, 6);
}

}  // namespace
}  // namespace poise
