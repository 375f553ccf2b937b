// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

struct _cairo;

namespace poise {

/// Red, green, blue and opacity, each in [0, 1].
using Color = Eigen::Vector4d;

/// 0x1f66d1 is "#1f66d1" elsewhere; opaque.
Color HexColor(unsigned rgb);

enum class Anchor { kLeft, kMiddle, kRight };

/// Where figures are drawn: points, x to the right and y down.
class Canvas {
 public:
  explicit Canvas(_cairo* cairo) : cairo_(cairo) {}

  void Polygon(const std::vector<Eigen::Vector2d>& corners, const Color& fill);
  void Line(const std::vector<Eigen::Vector2d>& points, const Color& color,
            double width, bool dashed = false);
  void Disk(const Eigen::Vector2d& center, double radius, const Color& fill);
  void Text(const Eigen::Vector2d& at, const std::string& text, double size,
            const Color& color, Anchor anchor = Anchor::kLeft,
            bool bold = false);
  double TextWidth(const std::string& text, double size, bool bold = false);

  /// What `draw` draws shows only in the rectangle.
  void Clipped(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
               const std::function<void()>& draw);
  /// An image of premultiplied ARGB pixels by row, stretched to the rectangle.
  void Image(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
             int width, int height, std::vector<std::uint32_t> pixels);

 private:
  void Path(const std::vector<Eigen::Vector2d>& points);
  void SetColor(const Color& color);

  _cairo* cairo_;
};

/// Pixels of a PNG for each point of a picture, along x and y.
constexpr double kPixelsPerPoint = 2;

/// Draws the same picture twice: STEM.svg and STEM.png. Throws
/// std::invalid_argument if a file cannot be written.
void WritePicture(const std::filesystem::path& stem,
                  const Eigen::Vector2d& size,
                  const std::function<void(Canvas*)>& draw);

}  // namespace poise
