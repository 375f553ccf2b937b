// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/add_meshes.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "poise/robot/urdf/urdf.h"
#include "poise/tests/util/mesh_writer.h"
#include "poise/tests/util/test_file.h"
#include "poise/tools/commands/report/robot_json.h"

namespace poise {
namespace {

using nlohmann::json;

const char kUrdf[] =
    "<robot name='r'><link name='a'><inertial><mass value='1'/><inertia "
    "ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial><visual>"
    "<origin xyz='1 2 3'/><geometry><mesh filename='package://p/a.stl' "
    "scale='0.1 0.1 0.1'/></geometry></visual><visual><geometry><box size="
    "'1 2 3'/></geometry></visual></link></robot>";

json RobotJson() {
  return MakeRobotJson({LoadUrdf(TestFile("robot.urdf", kUrdf)), {}, {}});
}

TEST(AddMeshes, DrawsMeshesInsteadOfTheirStandIns) {
  const std::filesystem::path packages =
      TestFile("robot.urdf", kUrdf).parent_path() / "packages";
  std::filesystem::create_directories(packages / "p");
  std::ofstream(packages / "p/a.stl")
      << BinaryStl(BoxMesh({0, 0, 0}, {1, 1, 1}));
  json robot = RobotJson();
  robot["shapes"].push_back({{"body", 0}, {"stand_in", true}});
  robot["shapes"].push_back({{"body", 1}, {"stand_in", true}});
  const json before = robot;
  AddMeshes({}, &robot);
  EXPECT_EQ(robot["shapes"], before["shapes"]);
  AddMeshes({packages}, &robot);
  // The mesh, the box and the stand-in of another body.
  ASSERT_EQ(robot["shapes"].size(), 3u);
  const json& mesh = robot["shapes"][0];
  EXPECT_EQ(mesh["kind"], "mesh");
  EXPECT_EQ(mesh["p"], json({1.0, 2.0, 3.0}));
  EXPECT_EQ(mesh["vertices"].get<std::string>().find("0 0 0 "), 0u);
  EXPECT_NE(mesh["vertices"].get<std::string>().find("1000"),
            std::string::npos);
  EXPECT_EQ(robot["shapes"][1]["kind"], "box");
  EXPECT_EQ(robot["shapes"][2]["body"], 1);
}

TEST(AddMeshes, LeavesOtherFilesUnchanged) {
  for (const char* text :
       {"null", "{}", "{\"unread_meshes\": 1}",
        "{\"unread_meshes\": [{\"file\": 1}], \"urdf\": \"a\"}"}) {
    json robot = json::parse(text);
    AddMeshes({"."}, &robot);
    EXPECT_EQ(robot, json::parse(text));
  }
}

}  // namespace
}  // namespace poise
