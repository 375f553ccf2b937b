// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/surrounding_rectangle.h"

#include <Eigen/Geometry>
#include <cmath>

namespace poise {
namespace {

using Eigen::Vector2d;

double Area(const TurnedRectangle& r) { return r.half_size.prod(); }

// Returns the rectangle around the polygon whose x axis has this angle.
TurnedRectangle RectangleAt(const std::vector<Vector2d>& polygon,
                            double angle) {
  const Eigen::Rotation2Dd turn(angle);
  Eigen::AlignedBox2d box;
  for (const Vector2d& corner : polygon) box.extend(turn.inverse() * corner);
  return {turn * box.center(), 0.5 * box.sizes(), angle};
}

}  // namespace

TurnedRectangle SurroundingRectangle(const std::vector<Vector2d>& polygon) {
  // Curved outlines have a smallest rectangle that is turned by chance. The
  // area of that rectangle is hardly smaller.
  constexpr double kClearlySmaller = 0.9;
  const TurnedRectangle straight = RectangleAt(polygon, 0);
  TurnedRectangle best = straight;
  for (size_t i = 0; i < polygon.size(); ++i) {
    // The smallest rectangle has a side along an edge of the polygon.
    const Vector2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double angle =
        std::remainder(std::atan2(edge.y(), edge.x()), M_PI / 2);
    const TurnedRectangle turned = RectangleAt(polygon, angle);
    if (Area(turned) < Area(best)) best = turned;
  }
  return Area(best) < kClearlySmaller * Area(straight) ? best : straight;
}

}  // namespace poise
