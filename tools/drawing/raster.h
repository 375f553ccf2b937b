// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "poise/tools/drawing/canvas.h"

namespace poise {

/// Draws triangles into a picture with a depth buffer, so that the nearest
/// surface is visible. Edges are antialiased: each pixel is the mean of
/// kSamples x kSamples samples.
class Raster {
 public:
  static constexpr int kSamples = 3;

  /// Makes an empty picture. The width and the height are in pixels.
  Raster(int width, int height);

  /// Draws a triangle. A corner is [x, y, depth], with x to the right and y
  /// down in pixels. The depth must be linear over the picture, and smaller for
  /// nearer points; -1 / distance satisfies both.
  void Triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                const Eigen::Vector3d& c, const Color& color);

  /// Returns the pixels, row by row, as premultiplied ARGB with 8 bits each and
  /// alpha in the highest bits. Pixels without a triangle are transparent.
  std::vector<std::uint32_t> Pixels() const;

  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_;
  int height_;
  std::vector<float> depth_;            // One entry per sample.
  std::vector<Eigen::Vector4f> color_;  // One entry per sample.
};

}  // namespace poise
