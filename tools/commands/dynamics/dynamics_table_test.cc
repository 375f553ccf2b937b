// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/dynamics/dynamics_table.h"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "poise/tools/commands/dynamics/dynamics_file.h"

namespace poise {
namespace {

using nlohmann::json;

constexpr char kLongName[] = "slide_with_a_name_longer_than_any_title";

// Makes a body with two arms, one on a revolute and one on a prismatic joint.
Tree MakeTree() {
  TreeBuilder builder;
  for (const char* name : {"body", "a", "b"}) {
    builder.AddLink(name,
                    {2, {0.1, 0.2, 0.3}, 0.1 * Eigen::Matrix3d::Identity()});
  }
  JointSpec turn;
  turn.name = "turn";
  turn.type = JointType::kRevolute;
  turn.parent = "body";
  turn.child = "a";
  JointSpec slide = turn;
  slide.name = kLongName;
  slide.type = JointType::kPrismatic;
  slide.child = "b";
  return builder.AddJoint(turn).AddJoint(slide).Build();
}

// Returns the lines of the tables of one state.
std::vector<std::string> Lines() {
  const json document = json::parse(std::string(R"({"joints": ["turn", ")") +
                                    kLongName + R"("], "states": [{
      "base_position": [1, 2, 3], "base_quaternion_wxyz": [1, 0, 0, 0],
      "base_angular_velocity": [0, 0, 0], "base_linear_velocity": [4, 5, -6],
      "base_angular_acceleration": [7, 8, 9],
      "base_linear_acceleration": [10, 11, 12],
      "q": [0.2, 0.3], "qd": [0, 0], "qdd": [0.6, 0.7]}]})");
  const Tree tree = MakeTree();
  std::istringstream text(
      FormatDynamics(tree, ComputeDynamics(tree, document, {"a"})));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> LinesThatStartWith(const std::string& start) {
  std::vector<std::string> found;
  for (const std::string& line : Lines()) {
    if (line.compare(0, start.size(), start) == 0) found.push_back(line);
  }
  return found;
}

TEST(FormatDynamics, HasARowForEachJoint) {
  EXPECT_EQ(Lines()[0],
            "body: 8 degrees of freedom, 6 kg. World axes; angular before "
            "linear.");
  // The three rows are those of the forces, of A_G and of J.
  for (const char* name : {"turn", kLongName, "base w_x", "base v_z"}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(LinesThatStartWith("  " + std::string(name) + " ").size(), 3);
  }
}

TEST(FormatDynamics, ShowsTheUnits) {
  for (const char* name : {"turn", "base w_y"}) {
    SCOPED_TRACE(name);
    const auto rows = LinesThatStartWith("  " + std::string(name) + " ");
    EXPECT_NE(rows[0].find("  N m, kg m2  "), std::string::npos);
    EXPECT_NE(rows[1].find("  at 1 rad/s  "), std::string::npos);
  }
  for (const char* name : {kLongName, "base v_y"}) {
    SCOPED_TRACE(name);
    const auto rows = LinesThatStartWith("  " + std::string(name) + " ");
    EXPECT_NE(rows[0].find("  N, kg  "), std::string::npos);
    EXPECT_NE(rows[1].find("  at 1 m/s  "), std::string::npos);
  }
}

TEST(FormatDynamics, HasTheColumnsOfTheMomentumMatrix) {
  // At 1 m/s along z the momentum, the last of six numbers, is the mass.
  const std::string row = LinesThatStartWith("  base v_z ")[1];
  EXPECT_EQ(row.substr(row.size() - 14), "             6");
}

// Returns how many columns a line takes in a terminal. The combining dot above
// v and J has two bytes and takes no column.
int WidthOf(std::string line) {
  for (size_t dot; (dot = line.find("\u0307")) != std::string::npos;) {
    line.erase(dot, 2);
  }
  return static_cast<int>(line.size());
}

TEST(FormatDynamics, AlignsColumns) {
  const int width = WidthOf(LinesThatStartWith("  A_G ")[0]);
  for (const char* start :
       {"  momentum about it, h_G ", "    its rate at v̇ = 0 ", "  base w_x ",
        "    its J̇v ", "    its J "}) {
    SCOPED_TRACE(start);
    EXPECT_EQ(WidthOf(LinesThatStartWith(start).back()), width);
  }
  // Rows with four or three cells end two or three columns of 14 earlier.
  const std::string long_name = "  " + std::string(kLongName) + " ";
  EXPECT_EQ(WidthOf(LinesThatStartWith("  forces, ")[0]), width - 28);
  EXPECT_EQ(WidthOf(LinesThatStartWith(long_name)[0]), width - 28);
  EXPECT_EQ(WidthOf(LinesThatStartWith("  center of mass ")[0]), width - 42);
  EXPECT_EQ(WidthOf(LinesThatStartWith("  a ")[0]), width - 42);
}

TEST(FormatDynamics, PrintsNoNegativeZeroAndNoTrailingBlanks) {
  for (const std::string& line : Lines()) {
    SCOPED_TRACE(line);
    EXPECT_EQ((line + " ").find(" -0 "), std::string::npos);
    EXPECT_TRUE(line.empty() || line.back() != ' ');
  }
}

}  // namespace
}  // namespace poise
