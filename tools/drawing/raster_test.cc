// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/drawing/raster.h"

#include <gtest/gtest.h>

namespace poise {
namespace {

const Color kRed(1, 0, 0, 1), kBlue(0, 0, 1, 1), kGlass(0, 0, 0, 0.2);

// Draws an axis-aligned rectangle of constant depth, as two triangles.
void Square(double x0, double y0, double x1, double y1, double depth,
            const Color& color, Raster* raster) {
  raster->Triangle({x0, y0, depth}, {x1, y0, depth}, {x1, y1, depth}, color);
  raster->Triangle({x0, y0, depth}, {x1, y1, depth}, {x0, y1, depth}, color);
}

TEST(Raster, FillsThePixelsInsideTriangles) {
  Raster raster(4, 2);
  Square(1, 0, 3, 1, 0, kRed, &raster);
  const std::vector<std::uint32_t> expected = {0, 0xffff0000, 0xffff0000, 0,
                                               0, 0,          0,          0};
  EXPECT_EQ(raster.Pixels(), expected);
}

TEST(Raster, DrawsTrianglesOfEitherOrientation) {
  Raster raster(1, 1);
  raster.Triangle({-9, -9, 0}, {-9, 9, 0}, {9, 9, 0}, kRed);
  raster.Triangle({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, kRed);
  EXPECT_EQ(raster.Pixels()[0], 0xffff0000u);
}

TEST(Raster, ShowsTheNearestSurface) {
  for (const bool red_first : {true, false}) {
    Raster raster(1, 1);
    if (red_first) Square(0, 0, 1, 1, -2, kRed, &raster);
    Square(0, 0, 1, 1, -1, kBlue, &raster);
    if (!red_first) Square(0, 0, 1, 1, -2, kRed, &raster);
    EXPECT_EQ(raster.Pixels()[0], 0xffff0000u);
  }
}

TEST(Raster, DrawsIntersectingSurfaces) {
  Raster raster(2, 1);
  Square(0, 0, 2, 1, 0.5, kBlue, &raster);
  // The depth increases from 0 at the left to 1 at the right.
  raster.Triangle({0, -9, 0}, {2, -9, 1}, {2, 9, 1}, kRed);
  raster.Triangle({0, -9, 0}, {2, 9, 1}, {0, 9, 0}, kRed);
  EXPECT_EQ(raster.Pixels(),
            (std::vector<std::uint32_t>{0xffff0000, 0xff0000ff}));
}

TEST(Raster, SmoothsEdgesAndKeepsOpacity) {
  Raster raster(2, 1);
  Square(0, 0, 1.0 / 3, 1, 0, kRed, &raster);
  Square(1, 0, 2, 1, 0, kGlass, &raster);
  // Premultiplied: a third of 255 is 0x55, and a fifth of 255 is 0x33.
  EXPECT_EQ(raster.Pixels(),
            (std::vector<std::uint32_t>{0x55550000, 0x33000000}));
}

TEST(Raster, IgnoresTrianglesOutsideThePicture) {
  Raster raster(1, 1);
  Square(5, 5, 6, 6, 0, kRed, &raster);
  Square(-6, 0, -5, 1, 0, kRed, &raster);
  raster.Triangle({0, 0, 0}, {1, 1, 0}, {2, 2, 0}, kRed);
  EXPECT_EQ(raster.Pixels()[0], 0u);
}

}  // namespace
}  // namespace poise
