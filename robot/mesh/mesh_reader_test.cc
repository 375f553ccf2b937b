// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/mesh_reader.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/robot/mesh/child_process.h"
#include "poise/tests/util/mesh_writer.h"
#include "poise/tests/util/test_file.h"

namespace poise {
namespace {

using Eigen::Vector3d;

const Vector3d kUnit(1, 1, 1);

bool HasAssimp() {
  return RunChild({"assimp", "version"}, {10, size_t{1} << 30, 1}).kind ==
         ChildEnd::Kind::kExited;
}

MeshPlaces Places() { return {TestFile("robot.urdf", ""), {}}; }

// Returns the message of the refusal of a mesh file, without the folder, or
// "accepted".
std::string Refusal(const std::string& file, const Vector3d& scale = kUnit) {
  const MeshPlaces places = Places();
  try {
    MeshReader(places).Read({file, scale});
  } catch (const std::invalid_argument& error) {
    std::string message = error.what();
    const std::string folder = places.urdf.parent_path().string() + "/";
    const size_t at = message.find(folder);
    return at == std::string::npos ? message : message.erase(at, folder.size());
  }
  return "accepted";
}

// Writes a file, then returns the message of its refusal.
std::string RefusalOf(const std::string& name, const std::string& bytes) {
  TestFile(name, bytes);
  return Refusal(name);
}

TriangleMesh SomeBox() { return BoxMesh({-0.5f, 0.1f, -0.25f}, {2, 1, 0.5f}); }

// Returns the corners of all triangles, in order.
std::vector<Eigen::Vector3f> Corners(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3f> corners;
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) corners.push_back(mesh.vertices[corner]);
  }
  return corners;
}

TEST(MeshReader, ReadsEachFormatAlikeAndAppliesTheScale) {
  std::vector<std::pair<std::string, std::string>> files = {
      {"a.stl", BinaryStl(SomeBox())},
      {"b.STL", TextStl(SomeBox())},
      {"c.obj", Obj(SomeBox())}};
  if (HasAssimp()) {
    TriangleMesh in_mm = SomeBox();
    for (Eigen::Vector3f& p : in_mm.vertices) p *= 1000;
    for (const std::string axis : {"X_UP", "Y_UP", "Z_UP"}) {
      files.emplace_back(axis + ".dae", Collada(in_mm, 0.001, axis));
    }
  }
  const MeshPlaces places = Places();
  MeshReader reader(places);
  for (const auto& [name, bytes] : files) {
    TestFile(name, bytes);
    const auto corners = Corners(reader.Read({name, {2, -1, 0.5}}));
    const auto expected = Corners(SomeBox());
    ASSERT_EQ(corners.size(), expected.size()) << name;
    for (size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector3f scaled(2 * expected[i].x(), -expected[i].y(),
                                   0.5f * expected[i].z());
      // The unit of COLLADA rounds floats below 4.
      EXPECT_LT((corners[i] - scaled).norm(), 1e-6) << name;
    }
  }
}

// A file that is broken, hostile or no mesh gives an error of one line.
TEST(MeshReader, RefusesHostileFilesInOneLine) {
  const std::string binary = BinaryStl(SomeBox());
  std::string huge_count = binary;
  huge_count.replace(80, 4, "\xff\xff\xff\xff");
  std::string overflow = binary;  // 50 times this count is 0 in 32 bits.
  overflow.replace(80, 4, std::string("\0\0\0\x80", 4));
  TriangleMesh infinite = SomeBox();
  infinite.vertices[5].y() = std::numeric_limits<float>::infinity();
  TriangleMesh nan = SomeBox();
  nan.vertices[0].x() = std::numeric_limits<float>::quiet_NaN();
  std::string noise(5000, '\0');
  std::mt19937 random(1);
  for (char& c : noise) c = static_cast<char>(random());
  const std::vector<std::pair<std::string, std::string>> files = {
      {"empty.stl", ""},
      {"empty.obj", ""},
      {"empty.dae", ""},
      {"truncated.stl", binary.substr(0, 300)},
      {"header_only.stl", binary.substr(0, 84)},
      {"huge_count.stl", huge_count},
      {"overflow.stl", overflow},
      {"infinite.stl", BinaryStl(infinite)},
      {"nan.stl", BinaryStl(nan)},
      {"nan_text.stl", TextStl(nan)},
      {"infinite.obj", Obj(infinite)},
      {"noise.stl", noise},
      {"solid_noise.stl", "solid foot\n" + noise},
      {"noise.obj", "v 1 2 3\nf 1 1 1\n" + noise},
      {"noise.dae", noise},
      {"noise.ply", noise},
      {"no_extension", binary},
      {"truncated_text.stl", TextStl(SomeBox()).substr(0, 400)},
      {"far_index.obj", "v 1 2 3\nf 1 2 -9223372036854775808\n"},
      {"endless_line.obj", "v 1 2 " + std::string(1 << 20, '9')},
      {"html.stl", "<!DOCTYPE html><html>404: not found</html>"},
      {"deep.dae", "<COLLADA>" +
                       [] {
                         std::string deep;
                         for (int i = 0; i < 100'000; ++i) deep += "<a>";
                         return deep;
                       }()},
  };
  for (const auto& [name, bytes] : files) {
    const std::string message = RefusalOf(name, bytes);
    EXPECT_EQ(message.find(name + ":"), 0u) << name << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_LT(message.size(), 200u) << message;
  }
}

TEST(MeshReader, NamesAGitLfsPointer) {
  const std::string pointer =
      "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 12345\n";
  for (const std::string name : {"a.stl", "a.obj", "a.dae", "a.glb"}) {
    EXPECT_EQ(RefusalOf(name, pointer),
              name + ": is a Git LFS pointer, fetch it with git lfs pull");
  }
}

TEST(MeshReader, RefusesWhatIsNoFile) {
  const std::filesystem::path folder = Places().urdf.parent_path();
  std::filesystem::create_directories(folder / "folder.stl");
  mkfifo((folder / "pipe.dae").c_str(), 0600);
  std::filesystem::remove(folder / "loop.stl");
  std::filesystem::create_symlink("loop.stl", folder / "loop.stl");
  for (const std::string name :
       {"folder.stl", "pipe.dae", "loop.stl", "missing.stl"}) {
    const std::string message = Refusal(name);
    EXPECT_EQ(message.find(name + ": is missing or no regular file, was "
                                  "searched in "),
              0u)
        << message;
  }
  // The first byte of this regular file cannot be read.
  std::filesystem::remove(folder / "memory.stl");
  std::filesystem::create_symlink("/proc/self/mem", folder / "memory.stl");
  EXPECT_EQ(Refusal("memory.stl"),
            "memory.stl: cannot be read: Input/output error");
}

TEST(MeshReader, SaysThatAssimpCannotReadAFile) {
  if (!HasAssimp()) GTEST_SKIP() << "the command assimp is not installed";
  EXPECT_EQ(Refusal("/proc/self/mem"),
            "/proc/self/mem: cannot be read by assimp (exit code 10)");
}

TEST(MeshReader, RefusesAMeshThatIsTooLarge) {
  TestFile("box.stl", BinaryStl(SomeBox()));
  EXPECT_EQ(Refusal("box.stl"), "accepted");
  EXPECT_EQ(Refusal("box.stl", {1000, 1, 1}),
            "box.stl: has a vertex 2000 m from its origin, must be within 10 "
            "m: correct the scale in the robot file");
  EXPECT_NE(
      Refusal("box.stl", {1, std::numeric_limits<double>::quiet_NaN(), 1}),
      "accepted");
}

// A sparse file takes no space on the disk. One that starts as a Git LFS
// pointer counts, but is refused before its content is read.
TEST(MeshReader, BoundsTheSizeOfAFileAndOfAllFiles) {
  const MeshPlaces places = Places();
  const std::filesystem::path file =
      TestFile("large.stl", "version https://git-lfs.github.com/spec/v1\n");
  std::filesystem::resize_file(file, size_t{200} << 20);
  EXPECT_EQ(Refusal("large.stl"),
            "large.stl: is not read: has more than 128 MiB");
  std::filesystem::resize_file(file, size_t{120} << 20);
  MeshReader reader(places);
  std::vector<std::string> messages;
  for (int i = 0; i < 5; ++i) {
    try {
      reader.Read({"large.stl", kUnit});
    } catch (const std::invalid_argument& error) {
      messages.push_back(error.what());
    }
  }
  ASSERT_EQ(messages.size(), 5u);
  EXPECT_NE(messages[3].find("is a Git LFS pointer"), std::string::npos);
  EXPECT_NE(messages[4].find("is not read: the robot's meshes have more than "
                             "512 MiB"),
            std::string::npos);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace poise
