// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/find_mesh.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace poise {
namespace {

using Path = std::filesystem::path;

// A folder of packages:
//     work/robots/legs/urdf/robot.urdf    the package `legs`
//     work/robots/legs/meshes/foot.stl
//     work/robots/arms/meshes/hand.stl
//     elsewhere/head/meshes/face.stl
class FindMeshTest : public testing::Test {
 protected:
  void SetUp() override {
    root_ = Path(std::getenv("TEST_TMPDIR")) / "find_mesh";
    for (const char* file : {"work/robots/legs/urdf/robot.urdf",
                             "work/robots/legs/meshes/foot.stl",
                             "work/robots/arms/meshes/hand.stl",
                             "elsewhere/head/meshes/face.stl"}) {
      std::filesystem::create_directories((root_ / file).parent_path());
      std::ofstream(root_ / file) << "text";
    }
    places_.urdf = root_ / "work/robots/legs/urdf/robot.urdf";
    unsetenv("ROS_PACKAGE_PATH");
    unsetenv("AMENT_PREFIX_PATH");
  }

  // Returns the path that was found, relative to the root.
  Path Find(const std::string& file) const {
    const Path path = FindMesh(places_, file).path;
    return path.empty() ? path : path.lexically_relative(root_);
  }

  Path root_;
  MeshPlaces places_;
};

TEST_F(FindMeshTest, SearchesPackagesUpwardFromTheUrdf) {
  EXPECT_EQ(Find("package://legs/meshes/foot.stl"),
            "work/robots/legs/meshes/foot.stl");
  EXPECT_EQ(Find("package://arms/meshes/hand.stl"),
            "work/robots/arms/meshes/hand.stl");
  EXPECT_EQ(Find("model://arms/meshes/hand.stl"),
            "work/robots/arms/meshes/hand.stl");
  EXPECT_EQ(Find("package://work/robots/arms/meshes/hand.stl"),
            "work/robots/arms/meshes/hand.stl");
}

TEST_F(FindMeshTest, SearchesPackagesInTheGivenFolders) {
  const std::string face = "package://head/meshes/face.stl";
  EXPECT_EQ(Find(face), "");
  const MeshPlace missing = FindMesh(places_, face);
  EXPECT_EQ(missing.searched,
            (root_ / "work/robots/legs/urdf").string() + " and above");
  places_.packages = {root_, root_ / "elsewhere"};
  EXPECT_EQ(Find(face), "elsewhere/head/meshes/face.stl");
  places_.packages = {root_ / "elsewhere/head"};
  EXPECT_EQ(Find(face), "elsewhere/head/meshes/face.stl");
  places_.packages = {root_ / "work"};
  EXPECT_EQ(FindMesh(places_, face).searched,
            missing.searched + ", " + (root_ / "work").string());
}

TEST_F(FindMeshTest, SearchesPackagesInTheFoldersOfRos) {
  const std::string face = "package://head/meshes/face.stl";
  const std::string folders = "/none::" + (root_ / "elsewhere").string();
  setenv("ROS_PACKAGE_PATH", folders.c_str(), 1);
  EXPECT_EQ(Find(face), "elsewhere/head/meshes/face.stl");
  unsetenv("ROS_PACKAGE_PATH");
  const Path prefix = root_ / "prefix";
  std::filesystem::create_directories(prefix);
  std::filesystem::remove(prefix / "share");
  std::filesystem::create_directory_symlink(root_ / "elsewhere",
                                            prefix / "share");
  setenv("AMENT_PREFIX_PATH", prefix.c_str(), 1);
  EXPECT_EQ(Find(face), "prefix/share/head/meshes/face.stl");
}

TEST_F(FindMeshTest, ResolvesOtherPathsFromTheUrdf) {
  EXPECT_EQ(Find("../meshes/foot.stl"), "work/robots/legs/meshes/foot.stl");
  const std::string absolute =
      (root_ / "work/robots/arms/meshes/hand.stl").string();
  EXPECT_EQ(Find(absolute), "work/robots/arms/meshes/hand.stl");
  EXPECT_EQ(Find("file://" + absolute), "work/robots/arms/meshes/hand.stl");
}

TEST_F(FindMeshTest, FindsNothingForOddNames) {
  for (const std::string file :
       {"", "package://", "package://legs", "package:///", "..", "/", "file://",
        "../meshes", "http://robots.org/foot.stl", "foot.stl"}) {
    EXPECT_EQ(Find(file), "") << file;
    EXPECT_NE(FindMesh(places_, file).searched, "") << file;
  }
  places_.urdf = "";  // The URDF is a text, not a file.
  EXPECT_EQ(Find("package://legs/meshes/foot.stl"), "");
}

}  // namespace
}  // namespace poise
