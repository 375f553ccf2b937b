// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/convert_mesh.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "poise/tests/util/mesh_writer.h"
#include "poise/tests/util/test_file.h"

namespace poise {
namespace {

namespace fs = std::filesystem;

// Puts a script in place of the command assimp. Without a script, no assimp is
// found.
class FakeAssimp {
 public:
  explicit FakeAssimp(const std::string& script) : path_(std::getenv("PATH")) {
    const fs::path file = TestFile("assimp", "#!/bin/sh\n" + script);
    fs::permissions(file, fs::perms::owner_all);
    if (script.empty()) {
      setenv("PATH", "/nowhere", 1);
    } else {
      setenv("PATH", (file.parent_path().string() + ":" + path_).c_str(), 1);
    }
  }
  ~FakeAssimp() { setenv("PATH", path_.c_str(), 1); }
  FakeAssimp(const FakeAssimp&) = delete;
  FakeAssimp& operator=(const FakeAssimp&) = delete;

 private:
  std::string path_;
};

// Returns the message after the file's name, or "accepted".
std::string Refusal(const std::string& script, double seconds = 100) {
  const FakeAssimp assimp(script);
  try {
    ConvertMesh("mesh.dae", seconds);
  } catch (const std::invalid_argument& error) {
    const std::string name = "mesh.dae: ", message = error.what();
    EXPECT_EQ(message.find(name), 0u) << message;
    return message.substr(name.size());
  }
  return "accepted";
}

TEST(ConvertMesh, SaysHowAssimpFailed) {
  EXPECT_EQ(Refusal(""),
            "needs the command assimp, which is not installed: install the "
            "package assimp-utils, or convert the mesh to STL");
  EXPECT_EQ(Refusal("exit 127"), "cannot be read by assimp (exit code 127)");
  EXPECT_EQ(Refusal("kill -SEGV $$"),
            "crashes assimp (signal 11), or needs more than 1 GiB");
  EXPECT_EQ(Refusal("exec sleep 1000", 0.1), "takes assimp more than 0.1 s");
  EXPECT_EQ(Refusal("exec cat /dev/zero > $3"),
            "becomes more than 128 MiB of triangles");
  EXPECT_EQ(Refusal("exit 0"),
            "cannot be converted by assimp: is truncated: has 0 bytes, an STL "
            "file has at least 84");
}

TEST(ConvertMesh, SaysThatTheExitCodeIsLost) {
  const auto before = signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(Refusal("exit 0"),
            "cannot be converted: the exit code of assimp is lost, because "
            "this program ignores SIGCHLD");
  signal(SIGCHLD, before);
}

TEST(ConvertMesh, ReadsTheFileThatAssimpWrites) {
  const TriangleMesh box = BoxMesh({0, 0, 0}, {1, 2, 3});
  const fs::path stl = TestFile("box.stl", BinaryStl(box));
  const FakeAssimp assimp("exec cat " + stl.string() + " > $3");
  EXPECT_EQ(ConvertMesh("mesh.dae", 100).triangles.size(),
            box.triangles.size());
}

}  // namespace
}  // namespace poise
