// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/dynamics/dynamics_file.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <stdexcept>

#include "poise/dynamics/kinematics.h"
#include "poise/dynamics/rnea.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Eigen::VectorXd;
using nlohmann::json;

// Makes a body with two arms. The file lists the arms in the opposite order.
Tree MakeTree() {
  TreeBuilder builder;
  for (const char* name : {"body", "a", "b"}) {
    builder.AddLink(name,
                    {2, {0.1, 0.2, 0.3}, 0.1 * Eigen::Matrix3d::Identity()});
  }
  for (const char* name : {"a", "b"}) {
    JointSpec joint;
    joint.name = std::string("to_") + name;
    joint.type = JointType::kRevolute;
    joint.parent = "body";
    joint.child = name;
    joint.X_PF.p.x() = *name == 'a' ? 0.5 : -0.7;
    joint.axis_F =
        *name == 'a' ? Eigen::Vector3d(1, 2, 3) : Eigen::Vector3d(0, 1, -1);
    builder.AddJoint(joint);
  }
  return builder.Build();
}

json MakeDocument() {
  return json::parse(R"({"joints": ["to_b", "to_a"], "note": 1, "states": [{
      "base_position": [1, 2, 3], "base_quaternion_wxyz": [0.5, -1, 1.5, 2],
      "base_angular_velocity": [1, 2, 3], "base_linear_velocity": [4, 5, 6],
      "base_angular_acceleration": [7, 8, 9],
      "base_linear_acceleration": [10, 11, 12],
      "q": [0.2, 0.3], "qd": [0.4, 0.5], "qdd": [0.6, 0.7]}]})");
}

std::string MessageOf(const json& document,
                      const std::vector<std::string>& frames = {}) {
  try {
    ComputeDynamics(MakeTree(), document, frames);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ComputeDynamics, TakesJointsInTheOrderOfTheFile) {
  const Tree tree = MakeTree();
  const json result = ComputeDynamics(tree, MakeDocument(), {"b"});
  VectorXd q(9), v(8), vdot(8), tau(8);
  q << 1, 2, 3, -1, 1.5, 2, 0.5, 0.3, 0.2;
  v << 1, 2, 3, 4, 5, 6, 0.5, 0.4;
  vdot << 7, 8, 9, 10, 11, 12, 0.7, 0.6;
  Recursion scratch(tree);
  ComputeRnea(tree, q, v, vdot, {}, &scratch, tau);
  std::swap(tau[6], tau[7]);
  const json& state = result["states"][0];
  for (int i = 0; i < 8; ++i) {
    EXPECT_NEAR(state["tau_inverse_dynamics"][i].get<double>(), tau[i],
                Rounding(500, 10));
    // tau = M v̇ + h, with v̇ in the order of the file.
    std::swap(vdot[6], vdot[7]);
    double sum = state["bias_h"][i];
    for (int j = 0; j < 8; ++j) {
      sum += state["M"][i][j].get<double>() * vdot[j];
    }
    std::swap(vdot[6], vdot[7]);
    EXPECT_NEAR(sum, tau[i], Rounding(500, 10));
  }
  std::vector<Pose> X_WB(3);
  ComputePoses(tree, q, &X_WB);
  const json& b = state["frames"]["b"];
  EXPECT_NEAR(b["p"][0].get<double>(), X_WB[2].p.x(), Rounding(4, 5));
  EXPECT_NEAR(b["R"][0][1].get<double>(), X_WB[2].R(0, 1), Rounding(1, 5));
  // The first joint of the file, to_b, moves b; the second does not.
  EXPECT_NE(b["J"][0][6].get<double>(), 0);
  EXPECT_EQ(b["J"][0][7].get<double>(), 0);
}

TEST(ComputeDynamics, KeepsUnknownKeys) {
  const json result = ComputeDynamics(MakeTree(), MakeDocument(), {});
  EXPECT_EQ(result["note"], 1);
  EXPECT_EQ(result["nv"], 8);
  EXPECT_EQ(result["total_mass"], 6);
  EXPECT_EQ(result["root_link"], "body");
  EXPECT_EQ(result["states"][0]["gravity_g"][5], 6 * 9.81);
}

TEST(ComputeDynamics, ComputesTheFramesNamedInAState) {
  json document = MakeDocument();
  document["states"][0]["frames"]["a"] = 0;
  const json result = ComputeDynamics(MakeTree(), document, {});
  EXPECT_EQ(result["states"][0]["frames"].size(), 1);
  EXPECT_TRUE(result["states"][0]["frames"]["a"].contains("Jdot_nu"));
}

TEST(ComputeDynamics, NamesTheInvalidEntry) {
  for (const json& root : {json::array(), json(), json("x")}) {
    EXPECT_EQ(MessageOf(root),
              "is " + root.dump() +
                  ", must be an object with the keys joints and states");
  }
  json document = MakeDocument();
  document["joints"][0] = "c";
  EXPECT_EQ(MessageOf(document), "joints: the robot has no joint \"c\"");
  document["joints"][0] = 7;
  EXPECT_EQ(MessageOf(document), "joints: the robot has no joint 7");
  document["joints"][0] = "to_a";
  EXPECT_EQ(MessageOf(document), "joints: \"to_a\" is listed twice");
  document["joints"] = "to_a";
  EXPECT_EQ(MessageOf(document),
            "document: 'joints' is \"to_a\", must be an array");
  document["joints"] = {"to_a"};
  EXPECT_EQ(MessageOf(document), "joints: 'to_b' is missing");
  document = MakeDocument();
  document["states"] = 1;
  EXPECT_EQ(MessageOf(document), "document: 'states' is 1, must be an array");
  document.erase("states");
  EXPECT_EQ(MessageOf(document), "document: has no key 'states'");
  document = MakeDocument();
  document["states"][0] = 3;
  EXPECT_EQ(MessageOf(document), "state 0: is 3, must be an object");
  document = MakeDocument();
  document["states"][0].erase("qd");
  EXPECT_EQ(MessageOf(document), "state 0: has no key 'qd'");
  document["states"][0]["qd"] = {1, 2, 3};
  EXPECT_EQ(MessageOf(document), "state 0: 'qd' has 3 entries, must have 2");
  document["states"][0]["qd"] = {1};
  EXPECT_EQ(MessageOf(document), "state 0: 'qd' has 1 entry, must have 2");
  document["states"][0]["qd"] = {1, "x"};
  EXPECT_EQ(MessageOf(document),
            "state 0: 'qd' has \"x\" at index 1, must be a finite number");
  document["states"][0]["qd"] = {NAN, 1};
  EXPECT_EQ(MessageOf(document),
            "state 0: 'qd' has null at index 0, must be a finite number");
  document["states"][0]["qd"] = 3;
  EXPECT_EQ(MessageOf(document), "state 0: 'qd' is 3, must be an array");
  document = MakeDocument();
  document["states"][0]["base_quaternion_wxyz"] = {0, 0, 0, 0};
  EXPECT_EQ(MessageOf(document),
            "state 0: 'base_quaternion_wxyz' must not be zero");
  document = MakeDocument();
  document["states"][0].erase("base_linear_velocity");
  EXPECT_EQ(MessageOf(document), "state 0: has no key 'base_linear_velocity'");
  EXPECT_EQ(MessageOf(MakeDocument(), {"foot"}),
            "state 0: the robot has no link 'foot'");
  document = MakeDocument();
  document["states"][0]["qd"] = {1e200, 1e200};
  EXPECT_EQ(MessageOf(document),
            "state 0: the results are not finite, the numbers must be smaller");
  document = MakeDocument();
  document["states"][0]["base_linear_acceleration"] = {1e308, 1e308, 1e308};
  EXPECT_EQ(MessageOf(document),
            "state 0: the results are not finite, the numbers must be smaller");
}

TEST(CheckFrames, NamesTheMissingLink) {
  CheckFrames(MakeTree(), {"a", "b"});
  try {
    CheckFrames(MakeTree(), {"a", "foot"});
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "--frames: the robot has no link 'foot'");
  }
}

}  // namespace
}  // namespace poise
