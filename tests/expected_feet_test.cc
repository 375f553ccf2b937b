// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The feet that FindFeet() finds in files of real robots.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/robot/feet/find_feet.h"
#include "poise/robot/feet/forward.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/tests/util/shared_data.h"

namespace poise {
namespace {

using Path = std::filesystem::path;

struct Found {
  std::string left, right;  // Links of the feet; empty if none are found.
  std::string forward;
  std::string warning;  // About the forward direction.
  std::string refusal;
};

Found FeetIn(const Path& file) {
  Found found;
  Robot robot{UrdfDocument(file).MakeModel(), {}, {}, false};
  std::vector<Finding> findings;
  try {
    robot.feet = FindFeet(robot.model, &findings);
  } catch (const std::invalid_argument& error) {
    found.refusal = error.what();
    return found;
  }
  found.left = robot.model.tree.frames()[robot.feet[0].frame].name;
  found.right = robot.model.tree.frames()[robot.feet[1].frame].name;
  found.forward = ForwardAxis(robot);
  for (const Finding& finding : findings) {
    if (finding.where == "forward direction") found.warning = finding.what;
  }
  return found;
}

TEST(ExpectedFeet, OfOurHumanoid) {
  const Found found = FeetIn("robot/models/humanoid.urdf");
  EXPECT_EQ(found.left, "l_foot");
  EXPECT_EQ(found.right, "r_foot");
  EXPECT_EQ(found.forward, "+x");
  EXPECT_EQ(found.warning, "");
}

TEST(ExpectedFeet, OfRealRobots) {
  const auto folder = SharedData("robots");
  if (!folder) GTEST_SKIP() << "the shared robot files are missing";
  std::ifstream stream(*folder / "EXPECTED.json");
  const auto expected = nlohmann::json::parse(stream);
  EXPECT_GT(expected.size(), 0u);
  for (const auto& [name, robot] : expected.items()) {
    SCOPED_TRACE(name);
    const Found found = FeetIn(*folder / (name + ".urdf"));
    if (robot["left_foot_link"].is_null()) {
      EXPECT_NE(found.refusal.find("two feet"), std::string::npos)
          << found.refusal;
      continue;
    }
    EXPECT_EQ(found.refusal, "");
    EXPECT_EQ(found.left, robot["left_foot_link"].get<std::string>());
    EXPECT_EQ(found.right, robot["right_foot_link"].get<std::string>());
    const auto forward = robot["forward"].get<std::string>();
    EXPECT_EQ(found.forward, forward);
    EXPECT_EQ(found.warning.empty(), forward == "+x") << found.warning;
  }
}

}  // namespace
}  // namespace poise
