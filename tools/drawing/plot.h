// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "poise/tools/drawing/canvas.h"

namespace poise {

/// One line of a plot: a quantity over time. x and y have the same size.
struct PlotLine {
  std::string name;
  Color color;
  std::vector<double> x;
  std::vector<double> y;
  bool dashed = false;
};

/// The contents of a plot.
struct PlotSpec {
  std::string title;
  std::string x_label = "time, s";
  std::vector<PlotLine> lines;
  /// Limits: a y value and a name each. They are drawn as horizontal dashed
  /// lines, and the y axis always includes them.
  std::vector<std::pair<double, std::string>> limits;
  /// An interval of x to shade: the time of a push, s.
  std::optional<std::pair<double, double>> band;
  /// Minimum extent of the y axis, in the unit of y.
  double least_extent = 0;
};

/// Draws a plot into a rectangle, with round numbers at the axes and a legend.
void DrawPlot(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
              const PlotSpec& spec, Canvas* canvas);

/// Returns at most `most` + 1 equidistant round numbers. Their distance is 1, 2
/// or 5 times a power of ten. The first number is at or below `low`, the last
/// number is at or above `high`.
std::vector<double> RoundTicks(double low, double high, int most);

}  // namespace poise
