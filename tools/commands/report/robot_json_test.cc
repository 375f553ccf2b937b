// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/robot_json.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <stdexcept>

#include "poise/robot/mesh/triangle_mesh.h"

namespace poise {
namespace {

using nlohmann::json;

Robot Leg() {
  JointSpec knee;
  knee.name = "knee";
  knee.type = JointType::kRevolute;
  knee.parent = "thigh";
  knee.child = "shank";
  knee.X_PF.p = {0, 0, -0.4};
  knee.axis_F = {0, 1, 0};
  JointSpec ankle;
  ankle.name = "ankle";
  ankle.parent = "shank";
  ankle.child = "foot";
  // The ankle frame is rotated by 90 degrees about z.
  ankle.X_PF.R << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  ankle.X_PF.p = {0, 0, -0.3};
  Inertia M;
  M.mass = 2;
  M.I_G_B.diagonal().setConstant(0.01);
  constexpr double kInf = std::numeric_limits<double>::infinity();
  Robot leg{{"leg",
             TreeBuilder()
                 .AddLink("thigh", M)
                 .AddLink("shank", M)
                 .AddLink("foot")
                 .AddJoint(knee)
                 .AddJoint(ankle)
                 .Build(),
             {{-1, kInf, 5, 240}},
             {},
             {},
             {},
             0},
            {},
            {}};
  Foot foot;
  foot.name = "left_foot";
  foot.body = 1;
  foot.frame = *leg.model.tree.FindFrame("foot");
  foot.X_BC.p = {0, 0.01, -0.35};
  foot.half_size = {0.1, 0.05};
  foot.polygon_C = {{0.1, 0.05}, {-0.1, 0.05}, {-0.1, -0.05}, {0.1, -0.05}};
  leg.feet.push_back(foot);
  return leg;
}

TEST(RobotJson, ContainsTheTree) {
  const json robot = MakeRobotJson(Leg());
  EXPECT_EQ(robot["format"], "poise-robot-1");
  EXPECT_EQ(robot["name"], "leg");
  EXPECT_EQ(robot["mass"], 4);
  ASSERT_EQ(robot["bodies"].size(), 2u);
  EXPECT_EQ(robot["bodies"][0], json({{"name", "thigh"}, {"parent", -1}}));
  EXPECT_EQ(robot["bodies"][1], json::parse(R"({
      "name": "shank", "parent": 0, "joint": "knee", "type": "revolute",
      "axis": [0.0, 1.0, 0.0], "p": [0.0, 0.0, -0.4],
      "quat": [0.0, 0.0, 0.0, 1.0]})"));
}

TEST(RobotJson, ContainsFixedLinks) {
  const json links = MakeRobotJson(Leg())["links"];
  ASSERT_EQ(links.size(), 3u);
  for (const json& link : links) {
    if (link["name"] != "foot") continue;
    EXPECT_EQ(link["body"], 1);
    EXPECT_EQ(link["p"], json({0.0, 0.0, -0.3}));
    EXPECT_NEAR(link["quat"][2].get<double>(), 0.5 * std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(link["quat"][3].get<double>(), 0.5 * std::sqrt(2.0), 1e-15);
  }
}

TEST(RobotJson, ContainsFeetShapesAndLimits) {
  const json robot = MakeRobotJson(Leg());
  const json& foot = robot["feet"][0];
  EXPECT_EQ(foot["name"], "left_foot");
  EXPECT_EQ(foot["body"], 1);
  EXPECT_EQ(foot["p"], json({0.0, 0.01, -0.35}));
  EXPECT_EQ(foot["half_size"], json({0.1, 0.05}));
  EXPECT_EQ(foot["polygon"][1], json({-0.1, 0.05}));
  EXPECT_EQ(robot["limits"]["knee"], json({{"lower", -1.0},
                                           {"upper", nullptr},
                                           {"velocity", 5.0},
                                           {"effort", 240.0}}));
  EXPECT_EQ(robot["shapes"][0]["kind"], "ellipsoid");
  EXPECT_EQ(robot["shapes"][1]["kind"], "capsule");
  EXPECT_EQ(robot["shapes"][0]["rgba"].size(), 4u);
}

TEST(RobotJson, WritesMeshesInTenthsOfAMillimeter) {
  Robot leg = Leg();
  TriangleMesh mesh;
  mesh.vertices = {{0, 0.1f, -0.0201f}, {1, 0, 0.00004f}, {0, 0, 2}};
  mesh.triangles = {{0, 1, 2}, {2, 1, 0}};
  leg.model.visuals.push_back(
      {0, {}, Mesh{"a.stl", {1, 1, 1}, std::make_shared<TriangleMesh>(mesh)}});
  const json shape = MakeRobotJson(leg)["shapes"][0];
  EXPECT_EQ(shape["kind"], "mesh");
  EXPECT_EQ(shape["vertices"], "0 1000 -201 10000 0 0 0 0 20000");
  EXPECT_EQ(shape["triangles"], "0 1 2 2 1 0");
}

}  // namespace
}  // namespace poise
