// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/drawing/canvas.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace poise {
namespace {

namespace fs = std::filesystem;

std::string Read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// Returns four bytes of a file, most significant first, as in a PNG.
unsigned Number(const std::string& bytes, size_t at) {
  unsigned number = 0;
  for (size_t i = at; i < at + 4; ++i) {
    number = 256 * number + static_cast<unsigned char>(bytes.at(i));
  }
  return number;
}

TEST(WritePicture, WritesThePictureTwice) {
  const fs::path stem = fs::path(testing::TempDir()) / "picture";
  const auto draw = [](Canvas* canvas) {
    canvas->Disk({30, 20}, 10, HexColor(0x1f66d1));
  };
  WritePicture(stem, {60, 40}, draw);
  const std::string svg = Read(stem.string() + ".svg");
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  // The size of the image stands behind its signature and the header's name.
  const std::string png = Read(stem.string() + ".png");
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(Number(png, 16), 60 * kPixelsPerPoint);
  EXPECT_EQ(Number(png, 20), 40 * kPixelsPerPoint);
  // Bytes of a PNG end with its last chunk.
  EXPECT_EQ(png.substr(png.size() - 8, 4), "IEND");
}

TEST(WritePicture, NamesAFileThatCannotBeWritten) {
  for (const char* kind : {".png", ".svg"}) {
    const fs::path stem = fs::path(testing::TempDir()) / "refused" / (kind + 1);
    const fs::path file = stem.string() + kind;
    fs::create_directories(file);
    try {
      WritePicture(stem, {60, 40}, [](Canvas*) {});
      ADD_FAILURE() << "no error about " << file;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(),
                file.string() + ": cannot be written: Is a directory");
    }
  }
}

}  // namespace
}  // namespace poise
