// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/drawing/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace poise {
namespace {

const Color kInk = HexColor(0x16191d);
const Color kFaint = HexColor(0x767e88);
const Color kGrid = HexColor(0xe3e6e9);
const Color kLimit = HexColor(0xc4281c);
constexpr double kFont = 9.5;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void Take(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void Widen(double least) {
    if (!(low <= high)) low = high = 0;
    const double missing = std::max(0.0, least - (high - low));
    low -= missing / 2;
    high += missing / 2;
    if (low == high) {
      low -= 1;
      high += 1;
    }
  }
};

std::string TickText(double value, double step) {
  const int digits =
      std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, std::abs(value));
  const bool negative = value < -step / 2;
  return negative ? "\u2212" + std::string(text) : text;
}

// Returns fewer points that give the same picture. Of all points in one column
// of pixels, only the lowest and the highest remain.
std::vector<Eigen::Vector2d> Thin(const std::vector<Eigen::Vector2d>& points) {
  std::vector<Eigen::Vector2d> thin;
  for (std::size_t i = 0; i < points.size();) {
    const double column = std::floor(2 * points[i].x());
    std::size_t low = i, high = i, next = i;
    for (; next < points.size() && std::floor(2 * points[next].x()) == column;
         ++next) {
      if (points[next].y() < points[low].y()) low = next;
      if (points[next].y() > points[high].y()) high = next;
    }
    thin.push_back(points[std::min(low, high)]);
    if (low != high) thin.push_back(points[std::max(low, high)]);
    i = next;
  }
  return thin;
}

// The ranges of a plot's axes, and the numbers printed along them.
struct Axes {
  Range x, y;
  std::vector<double> x_ticks, y_ticks;
};

Axes MakeAxes(const PlotSpec& spec) {
  Axes axes;
  Range& x = axes.x;
  Range& y = axes.y;
  for (const PlotLine& line : spec.lines) {
    for (const double value : line.x) x.Take(value);
    for (const double value : line.y) y.Take(value);
  }
  for (const auto& [value, name] : spec.limits) y.Take(value);
  x.Widen(0);
  y.Widen(spec.least_extent);
  axes.y_ticks = RoundTicks(y.low, y.high, 6);
  axes.x_ticks = RoundTicks(x.low, x.high, 10);
  y = {axes.y_ticks.front(), axes.y_ticks.back()};
  // The last row of a log is one time step before the end. So the x axis
  // extends to the next tick if that is within 0.5 % of the range.
  const double near_end = x.high + 0.005 * (x.high - x.low);
  for (const double tick : axes.x_ticks) {
    if (tick < near_end) x.high = std::max(x.high, tick);
  }
  return axes;
}

// The rectangle between the axes, in points on the canvas.
struct Frame {
  Eigen::Vector2d at, area;
  Range x, y;

  // Returns the point on the canvas of a value at a time.
  Eigen::Vector2d Map(double time, double value) const {
    return {at.x() + area.x() * (time - x.low) / (x.high - x.low),
            at.y() + area.y() * (y.high - value) / (y.high - y.low)};
  }
};

void DrawBand(const PlotSpec& spec, const Frame& frame, Canvas* canvas) {
  if (spec.band) {
    const double left = frame.Map(spec.band->first, 0).x();
    const double right =
        std::max(left + 1, frame.Map(spec.band->second, 0).x());
    Color shade = HexColor(0xd92d20);
    shade[3] = 0.13;
    canvas->Polygon({{left, frame.at.y()},
                     {right, frame.at.y()},
                     {right, frame.at.y() + frame.area.y()},
                     {left, frame.at.y() + frame.area.y()}},
                    shade);
  }
}

// Draws the horizontal grid lines, and the numbers along both axes.
void DrawGrid(const PlotSpec& spec, const Axes& axes, const Frame& frame,
              Canvas* canvas) {
  for (const double tick : axes.y_ticks) {
    canvas->Line({frame.Map(axes.x.low, tick), frame.Map(axes.x.high, tick)},
                 kGrid, 0.8);
    canvas->Text(frame.Map(axes.x.low, tick) + Eigen::Vector2d(-6, 3.3),
                 TickText(tick, axes.y_ticks[1] - axes.y_ticks[0]), kFont,
                 kFaint, Anchor::kRight);
  }
  for (const double tick : axes.x_ticks) {
    if (tick < axes.x.low - 1e-9 || tick > axes.x.high + 1e-9) continue;
    canvas->Text(frame.Map(tick, axes.y.low) + Eigen::Vector2d(0, 14),
                 TickText(tick, axes.x_ticks[1] - axes.x_ticks[0]), kFont,
                 kFaint, Anchor::kMiddle);
  }
  canvas->Text(frame.at + frame.area + Eigen::Vector2d(0, 27), spec.x_label,
               kFont, kFaint, Anchor::kRight);
}

void DrawLines(const PlotSpec& spec, const Axes& axes, const Frame& frame,
               Canvas* canvas) {
  canvas->Clipped(
      frame.at - Eigen::Vector2d(0, 2), frame.area + Eigen::Vector2d(0, 4),
      [&] {
        for (const PlotLine& line : spec.lines) {
          std::vector<Eigen::Vector2d> points;
          for (std::size_t i = 0; i < line.x.size(); ++i) {
            if (std::isfinite(line.y[i])) {
              points.push_back(frame.Map(line.x[i], line.y[i]));
            }
          }
          canvas->Line(Thin(points), line.color, 1.5, line.dashed);
        }
        for (const auto& [value, name] : spec.limits) {
          canvas->Line(
              {frame.Map(axes.x.low, value), frame.Map(axes.x.high, value)},
              kLimit, 1, true);
          canvas->Text(frame.Map(axes.x.high, value) + Eigen::Vector2d(-4, -4),
                       name, kFont - 1, kLimit, Anchor::kRight);
        }
      });
}

// Draws the title on the left and the names of the lines on the right.
void DrawTitle(const PlotSpec& spec, const Eigen::Vector2d& corner,
               const Frame& frame, Canvas* canvas) {
  canvas->Text(corner + Eigen::Vector2d(12, 15), spec.title, 11, kInk,
               Anchor::kLeft, /*bold=*/true);
  double right = frame.at.x() + frame.area.x();
  for (auto line = spec.lines.rbegin(); line != spec.lines.rend(); ++line) {
    if (line->name.empty()) continue;
    right -= canvas->TextWidth(line->name, kFont);
    canvas->Text({right, corner.y() + 15}, line->name, kFont, kInk);
    canvas->Line(
        {{right - 20, corner.y() + 11.5}, {right - 5, corner.y() + 11.5}},
        line->color, 2, line->dashed);
    right -= 34;
  }
}

}  // namespace

std::vector<double> RoundTicks(double low, double high, int most) {
  const double rough = (high - low) / most;
  double step = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {2.0, 2.5, 2.0}) {
    const double count =
        std::ceil(high / step - 1e-9) - std::floor(low / step + 1e-9);
    if (count <= most) break;
    step *= factor;
  }
  std::vector<double> ticks;
  const double first = std::floor(low / step + 1e-9);
  const double last = std::ceil(high / step - 1e-9);
  for (double i = first; i <= last; ++i) ticks.push_back(i * step);
  return ticks;
}

void DrawPlot(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
              const PlotSpec& spec, Canvas* canvas) {
  const Axes axes = MakeAxes(spec);
  const Frame frame{corner + Eigen::Vector2d(46, 26),
                    size - Eigen::Vector2d(58, 60), axes.x, axes.y};
  DrawBand(spec, frame, canvas);
  DrawGrid(spec, axes, frame, canvas);
  DrawLines(spec, axes, frame, canvas);
  DrawTitle(spec, corner, frame, canvas);
}

}  // namespace poise
