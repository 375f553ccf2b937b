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

/// Returns an opaque color from its RGB code: 0x1f66d1 for CSS "#1f66d1".
Color HexColor(unsigned rgb);

enum class Anchor { kLeft, kMiddle, kRight };

/// A surface to draw on. Coordinates are in points (1/72 inch in the SVG), with
/// x to the right and y down from the top left corner.
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

  /// Calls `draw`, and clips its drawing to the rectangle.
  void Clipped(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
               const std::function<void()>& draw);
  /// Draws an image, stretched to the rectangle. The pixels are premultiplied
  /// ARGB, stored row by row.
  void Image(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
             int width, int height, std::vector<std::uint32_t> pixels);

 private:
  void Path(const std::vector<Eigen::Vector2d>& points);
  void SetColor(const Color& color);

  _cairo* cairo_;
};

/// Pixels of the PNG per point of a picture, along x and along y.
constexpr double kPixelsPerPoint = 2;

/// Writes a picture to two files, STEM.svg and STEM.png. Calls `draw` once for
/// each file. The size is in points. Throws std::invalid_argument if a file
/// cannot be written.
void WritePicture(const std::filesystem::path& stem,
                  const Eigen::Vector2d& size,
                  const std::function<void(Canvas*)>& draw);

}  // namespace poise
