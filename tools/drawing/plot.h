// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "poise/tools/drawing/canvas.h"

namespace poise {

/// A quantity over time.
struct PlotLine {
  std::string name;
  Color color;
  std::vector<double> x;
  std::vector<double> y;
  bool dashed = false;
};

/// A plot, as data.
struct PlotSpec {
  std::string title;
  std::string x_label = "time, s";
  std::vector<PlotLine> lines;
  /// Limits: dashed lines across, each with a name; in view, always.
  std::vector<std::pair<double, std::string>> limits;
  /// A time to shade: that of a push.
  std::optional<std::pair<double, double>> band;
  /// The least extent of the y axis.
  double least_extent = 0;
};

/// Draws a plot into the rectangle: axes with round ticks, lines, a legend.
void DrawPlot(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
              const PlotSpec& spec, Canvas* canvas);

/// Round numbers, at most `most` + 1 of them, from below `low` or at it to
/// above `high` or at it; multiples of 1, 2 or 5 times a power of ten.
std::vector<double> RoundTicks(double low, double high, int most);

}  // namespace poise
