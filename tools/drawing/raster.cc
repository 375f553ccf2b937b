// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/drawing/raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poise {
namespace {

// Returns twice the signed area of the triangle a, b, (x, y).
double Cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double x,
             double y) {
  return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

}  // namespace

Raster::Raster(int width, int height)
    : width_(width),
      height_(height),
      depth_(static_cast<std::size_t>(width * height * kSamples * kSamples),
             std::numeric_limits<float>::infinity()),
      color_(depth_.size(), Eigen::Vector4f::Zero()) {}

void Raster::Triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      const Eigen::Vector3d& c, const Color& color) {
  const double area = Cross(a, b, c.x(), c.y());
  if (area == 0 || !std::isfinite(area)) return;
  const int columns = width_ * kSamples, rows = height_ * kSamples;
  const auto first = [](double u, double v, double w, int most) {
    const double low = std::min({u, v, w}) * kSamples - 0.5;
    return static_cast<int>(std::clamp(std::ceil(low), 0.0, 1.0 * most));
  };
  const auto last = [](double u, double v, double w, int most) {
    const double high = std::max({u, v, w}) * kSamples - 0.5;
    return static_cast<int>(std::clamp(std::floor(high), -1.0, most - 1.0));
  };
  const Eigen::Vector4f shown = color.cast<float>();
  const int x_end = last(a.x(), b.x(), c.x(), columns);
  const int y_end = last(a.y(), b.y(), c.y(), rows);
  for (int j = first(a.y(), b.y(), c.y(), rows); j <= y_end; ++j) {
    const double y = (j + 0.5) / kSamples;
    for (int i = first(a.x(), b.x(), c.x(), columns); i <= x_end; ++i) {
      const double x = (i + 0.5) / kSamples;
      const double wa = Cross(b, c, x, y) / area;
      const double wb = Cross(c, a, x, y) / area;
      const double wc = 1 - wa - wb;
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const auto depth =
          static_cast<float>(wa * a.z() + wb * b.z() + wc * c.z());
      const auto sample = static_cast<std::size_t>(j) * columns + i;
      if (depth >= depth_[sample]) continue;
      depth_[sample] = depth;
      color_[sample] = shown;
    }
  }
}

std::vector<std::uint32_t> Raster::Pixels() const {
  std::vector<std::uint32_t> pixels;
  pixels.reserve(static_cast<std::size_t>(width_) * height_);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      Eigen::Vector4f sum = Eigen::Vector4f::Zero();
      for (int j = 0; j < kSamples; ++j) {
        for (int i = 0; i < kSamples; ++i) {
          const Eigen::Vector4f& color =
              color_[static_cast<std::size_t>(y * kSamples + j) * width_ *
                         kSamples +
                     x * kSamples + i];
          sum.head<3>() += color[3] * color.head<3>();
          sum[3] += color[3];
        }
      }
      sum *= 255.0f / (kSamples * kSamples);
      const auto byte = [&sum](int channel) {
        return static_cast<std::uint32_t>(std::lround(sum[channel]));
      };
      pixels.push_back(byte(3) << 24 | byte(0) << 16 | byte(1) << 8 | byte(2));
    }
  }
  return pixels;
}

}  // namespace poise
