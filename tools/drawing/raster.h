// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "poise/tools/drawing/canvas.h"

namespace poise {

/// A picture of triangles, the nearest on top, with smooth edges: each pixel is
/// the mean of kSamples x kSamples samples.
class Raster {
 public:
  static constexpr int kSamples = 3;

  /// Of so many pixels.
  Raster(int width, int height);

  /// Corners are [x, y, depth]: pixels to the right and down, and a depth that
  /// is linear on the picture and smaller nearby (-1 / distance is).
  void Triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                const Eigen::Vector3d& c, const Color& color);

  /// Premultiplied, 8 bits each: alpha, red, green, blue from the highest; by
  /// row. Transparent where nothing is.
  std::vector<std::uint32_t> Pixels() const;

  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_;
  int height_;
  std::vector<float> depth_;            // By sample.
  std::vector<Eigen::Vector4f> color_;  // By sample.
};

}  // namespace poise
