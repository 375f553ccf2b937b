// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/read_obj.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "poise/tests/util/mesh_writer.h"

namespace poise {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

TriangleMesh Read(const std::string& text) { return ReadObj(text, "a.obj"); }

// Returns the message of the refusal, or "accepted".
std::string Refusal(const std::string& text) {
  try {
    Read(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ReadObj, ReadsVerticesAndTriangles) {
  const TriangleMesh box = BoxMesh({-1, 0.1f, -3e-5f}, {2, 1, 0.3f});
  const TriangleMesh mesh = Read(Obj(box));
  ASSERT_EQ(mesh.triangles.size(), box.triangles.size());
  for (size_t i = 0; i < box.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(mesh.vertices[mesh.triangles[i][k]],
                box.vertices[box.triangles[i][k]]);
    }
  }
}

const char kFour[] = "v 0 0 0\nv 1 0 0 0.5\nv +1 1e0 0\nv 0 1 0 # fourth\n";

TEST(ReadObj, CutsAFaceIntoAFan) {
  EXPECT_EQ(Read(std::string(kFour) + "f 1/7 2/8/9 3//1 4 # all").triangles,
            (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ReadObj, CountsNegativeIndicesFromTheLastVertex) {
  EXPECT_EQ(Read(std::string(kFour) + "f -4 -3 -1").triangles,
            (Triangles{{0, 1, 2}}));
  EXPECT_EQ(Read(std::string(kFour) + "f -4 -3 -1").vertices[2],
            Eigen::Vector3f(0, 1, 0));
}

TEST(ReadObj, KeepsUnusedVerticesOnlyWithoutFaces) {
  EXPECT_EQ(Read(kFour).vertices.size(), 4u);
  EXPECT_EQ(Read(std::string(kFour) + "f 1 2 3").vertices.size(), 3u);
}

TEST(ReadObj, ReportsWhatIsWrong) {
  EXPECT_EQ(Refusal(""), "a.obj: has no vertices");
  EXPECT_EQ(Refusal("o foot\nvn 0 0 1\n"), "a.obj: has no vertices");
  EXPECT_EQ(Refusal("v 1 2\n"), "a.obj:1: a coordinate is missing");
  EXPECT_EQ(Refusal("v 1 2 -inf\n"),
            "a.obj:1: coordinate is '-inf', must be finite");
  EXPECT_EQ(Refusal(std::string(kFour) + "f 1 2"),
            "a.obj:5: a face has fewer than 3 corners");
  EXPECT_EQ(Refusal(std::string(kFour) + "f 1 2 5"),
            "a.obj:5: corner of a face is '5', the file has 4 vertices before "
            "it");
  for (const std::string corner :
       {"0", "-5", "99999999999999999999", "x", "/1", ""}) {
    const std::string message =
        Refusal(std::string(kFour) + "f 1 2 " + corner + "/ 3");
    EXPECT_EQ(message.find("a.obj:5: corner of a face is"), 0u) << message;
  }
  EXPECT_EQ(Refusal(std::string("v 1 2 3\n\0", 9)),
            "a.obj: is binary, must be UTF-8 text");
}

}  // namespace
}  // namespace poise
