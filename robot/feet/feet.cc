// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/feet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace poise {
namespace {

using Eigen::Vector2d;

double Cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Returns the lowest and the highest y of a convex polygon at x. If a side at x
// is parallel to y up to rounding, both of its ends are included.
std::pair<double, double> ExtentAt(const std::vector<Vector2d>& polygon,
                                   double x) {
  constexpr double kRounding = 1e-9;  // m.
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d& a = polygon[i];
    const Vector2d& b = polygon[(i + 1) % polygon.size()];
    const auto [left, right] = std::minmax({a.x(), b.x()});
    if (x < left - kRounding || x > right + kRounding) continue;
    const bool is_along_y = right - left <= kRounding;
    const double t = (x - a.x()) / (b.x() - a.x());
    const double y =
        is_along_y ? a.y() : a.y() + std::clamp(t, 0., 1.) * (b.y() - a.y());
    low = std::min({low, y, is_along_y ? b.y() : y});
    high = std::max({high, y, is_along_y ? b.y() : y});
  }
  return {low, high};
}

// Finds the maximum of a unimodal function by golden-section search. Each step
// reuses one of the two inner points.
template <typename Function>
double ArgMax(double low, double high, const Function& f) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  constexpr int kSteps = 80;  // golden^80 is below 2e-17.
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double f_a = f(a), f_b = f(b);
  for (int i = 0; i < kSteps; ++i) {
    if (f_a < f_b) {
      low = a;
      a = b;
      f_a = f_b;
      b = low + golden * (high - low);
      f_b = f(b);
    } else {
      high = b;
      b = a;
      f_b = f_a;
      a = high - golden * (high - low);
      f_a = f(a);
    }
  }
  return 0.5 * (low + high);
}

// Returns the convex polygon, reduced to at most kMostCorners of its corners.
std::vector<Vector2d> Thin(const std::vector<Vector2d>& polygon) {
  constexpr int kMostCorners = 64;
  if (polygon.size() <= kMostCorners) return polygon;
  std::vector<Vector2d> corners;
  for (int i = 0; i < kMostCorners; ++i) {
    const double angle = 2 * M_PI * i / kMostCorners;
    const Vector2d direction(std::cos(angle), std::sin(angle));
    corners.push_back(
        *std::max_element(polygon.begin(), polygon.end(),
                          [&](const Vector2d& a, const Vector2d& b) {
                            return a.dot(direction) < b.dot(direction);
                          }));
  }
  return ConvexHull(std::move(corners));
}

}  // namespace

std::vector<Vector2d> ConvexHull(std::vector<Vector2d> points) {
  std::sort(
      points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
        return std::make_pair(a.x(), a.y()) < std::make_pair(b.x(), b.y());
      });
  // Andrew's monotone chain: first the lower hull, then the upper hull.
  std::vector<Vector2d> hull;
  for (const int side : {0, 1}) {
    const size_t start = hull.size();
    for (const Vector2d& point : points) {
      while (hull.size() >= start + 2 &&
             Cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <=
                 0) {
        hull.pop_back();
      }
      hull.push_back(point);
    }
    if (!hull.empty()) hull.pop_back();  // The next chain starts with it.
    if (side == 0) std::reverse(points.begin(), points.end());
  }
  return hull;
}

bool IsConvex(const std::vector<Vector2d>& corners) {
  constexpr double kRounding = 1e-3;  // rad. Files round to six digits.
  std::vector<Vector2d> edges;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vector2d edge = corners[(i + 1) % corners.size()] - corners[i];
    if (edge.norm() > 0) edges.push_back(edge);
  }
  double turned = 0;
  double least = M_PI;
  double most = -M_PI;
  for (size_t i = 0; i < edges.size(); ++i) {
    const Vector2d& next = edges[(i + 1) % edges.size()];
    const double turn = std::atan2(Cross(edges[i], next), edges[i].dot(next));
    turned += turn;
    least = std::min(least, turn);
    most = std::max(most, turn);
  }
  // A polygon is convex if all turns have the same sign and add up to 2 pi. The
  // bound 3 pi excludes polygons that go around twice, such as a star.
  return (least >= -kRounding || most <= kRounding) &&
         std::abs(turned) < 3 * M_PI;
}

Rectangle LargestRectangle(const std::vector<Vector2d>& polygon) {
  double left = polygon[0].x();
  double right = left;
  for (const Vector2d& corner : polygon) {
    left = std::min(left, corner.x());
    right = std::max(right, corner.x());
  }
  const auto extent = [&](double x1, double x2) {
    const auto [low1, high1] = ExtentAt(polygon, x1);
    const auto [low2, high2] = ExtentAt(polygon, x2);
    return std::make_pair(std::max(low1, low2), std::min(high1, high2));
  };
  // The logarithms of width and height are concave in (x1, x2). So is the
  // logarithm of the area, which is therefore unimodal in x1 and in x2.
  const auto area = [&](double x1, double x2) {
    const auto [low, high] = extent(x1, x2);
    return (x2 - x1) * (high - low);
  };
  const auto best_end = [&](double x1) {
    return ArgMax(x1, right, [&](double x2) { return area(x1, x2); });
  };
  const double x1 =
      ArgMax(left, right, [&](double x) { return area(x, best_end(x)); });
  const double x2 = best_end(x1);
  const auto [low, high] = extent(x1, x2);
  return {{0.5 * (x1 + x2), 0.5 * (low + high)},
          {0.5 * (x2 - x1), 0.5 * (high - low)}};
}

std::optional<Foot> MakeFoot(const RobotModel& model, std::string name,
                             int frame, const Pose& X_FS,
                             const std::vector<Vector2d>& sole_S) {
  constexpr double kSmallest = 5e-4;  // Half of a side, m.
  std::vector<Vector2d> polygon = Thin(ConvexHull(sole_S));
  if (polygon.size() < 3) return std::nullopt;
  const Rectangle rectangle = LargestRectangle(polygon);
  if (!(rectangle.half_size.minCoeff() >= kSmallest)) return std::nullopt;
  for (Vector2d& corner : polygon) corner -= rectangle.center;
  const Frame& link = model.tree.frames()[frame];
  const Pose X_SC{Eigen::Matrix3d::Identity(),
                  {rectangle.center.x(), rectangle.center.y(), 0}};
  return Foot{std::move(name),         link.body,           frame,
              link.X_BF * X_FS * X_SC, rectangle.half_size, std::move(polygon)};
}

}  // namespace poise
