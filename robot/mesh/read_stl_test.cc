// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/read_stl.h"

#include <gtest/gtest.h>

#include <cctype>
#include <stdexcept>
#include <string>

#include "poise/tests/util/mesh_writer.h"

namespace poise {
namespace {

TriangleMesh SomeBox() { return BoxMesh({-1, 0.1f, -3e-5f}, {2, 1, 0.3f}); }

// Returns the message of the refusal, or "accepted".
std::string Refusal(const std::string& bytes) {
  try {
    ReadStl(bytes, "a.stl");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

// Expects the corners of all triangles to be those of the box, in order.
void ExpectBox(const TriangleMesh& mesh) {
  const TriangleMesh box = SomeBox();
  ASSERT_EQ(mesh.triangles.size(), box.triangles.size());
  for (size_t i = 0; i < box.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(mesh.vertices[mesh.triangles[i][k]],
                box.vertices[box.triangles[i][k]]);
    }
  }
}

TEST(ReadStl, ReadsBinaryAndTextAlike) {
  ExpectBox(ReadStl(BinaryStl(SomeBox()), "a.stl"));
  ExpectBox(ReadStl(TextStl(SomeBox()), "a.stl"));
}

TEST(ReadStl, ReadsBinaryThatBeginsWithSolid) {
  ExpectBox(ReadStl(BinaryStl(SomeBox(), "solid left foot"), "a.stl"));
}

TEST(ReadStl, IgnoresBytesAfterTheLastTriangle) {
  ExpectBox(ReadStl(BinaryStl(SomeBox()) + "appendix", "a.stl"));
}

TEST(ReadStl, AcceptsAnyLineBreakAndAnyName) {
  std::string text = TextStl(SomeBox());
  text.replace(0, 12, "solid vertex 1 facet");
  std::string other;
  for (const char c : text) {
    if (c == '\n') {
      other += '\r';
    } else {
      other += c;
    }
  }
  ExpectBox(ReadStl(text, "a.stl"));
  ExpectBox(ReadStl(other, "a.stl"));
}

TEST(ReadStl, AcceptsCapitalLettersAndAByteOrderMark) {
  std::string text = TextStl(SomeBox());
  ExpectBox(ReadStl("\xef\xbb\xbf" + text, "a.stl"));
  for (char& c : text) c = static_cast<char>(std::toupper(c));
  ExpectBox(ReadStl(text, "a.stl"));
  ExpectBox(ReadStl("\xef\xbb\xbf" + text, "a.stl"));
  EXPECT_EQ(Refusal(std::string("\xff\xfes\0o\0l\0i\0d\0", 12)),
            "a.stl: is a text in UTF-16, must be ASCII or UTF-8");
}

TEST(ReadStl, ReadsABinaryFileThatBeginsWithSolidAndHasAnAppendix) {
  for (const char* header : {"solid foot", "SOLID"}) {
    ExpectBox(ReadStl(BinaryStl(SomeBox(), header) + "appendix", "a.stl"));
  }
}

TEST(ReadStl, ReportsWhatIsWrong) {
  const std::string binary = BinaryStl(SomeBox());
  const std::string text = TextStl(SomeBox());
  EXPECT_EQ(Refusal(""),
            "a.stl: is truncated: has 0 bytes, an STL file has at least 84");
  EXPECT_EQ(Refusal(binary.substr(0, binary.size() - 1)),
            "a.stl: is truncated or no STL file: has 11 triangles, must have "
            "12");
  EXPECT_EQ(Refusal(BinaryStl({})), "a.stl: has no triangles");
  EXPECT_EQ(Refusal("solid nothing"), "a.stl: has no triangles");
  EXPECT_EQ(Refusal(text.substr(0, text.rfind("vertex"))),
            "a.stl: is truncated: the last facet is not complete");
  EXPECT_EQ(Refusal("solid\nfacet\nvertex 1 2\n"),
            "a.stl:3: a coordinate is missing");
  EXPECT_EQ(Refusal("solid\nfacet\nvertex 1 2 x\n"),
            "a.stl:3: coordinate is 'x', must be a number");
  EXPECT_EQ(Refusal("solid\nfacet\nvertex 1 2 nan\n"),
            "a.stl:3: coordinate is 'nan', must be finite");
  EXPECT_EQ(Refusal("solid\nfacet\nvertex 1 2 1e999\n"),
            "a.stl:3: coordinate is '1e999', must be finite");
  EXPECT_EQ(Refusal("solid\nfacet\nendfacet\n"),
            "a.stl:3: a facet has fewer than 3 vertices");
  EXPECT_EQ(Refusal("solid\nfacet\nvertex 1 2 3 vertex 1 2 3 vertex 1 2 3\n"
                    "vertex 1 2 3\n"),
            "a.stl:4: a facet has more than 3 vertices");
  EXPECT_EQ(Refusal("solid\nface\n"),
            "a.stl:2: unknown word 'face' in an STL file");
}

}  // namespace
}  // namespace poise
