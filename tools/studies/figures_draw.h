// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/sim/experiment.h"

namespace poise {

/// A run that figures are drawn from.
struct FigureRun {
  std::string name;  ///< Of its folder.
  Experiment experiment;
};

/// A figure of the paper, and what ours is.
struct Figure {
  int number;
  std::string caption;
  std::string paper;  ///< What the paper's shows.
  std::string ours;   ///< What ours shows, with its numbers.
};

/// The runs of a robot that the figures need, from the scenarios in a folder.
std::vector<FigureRun> MakeFigureRuns(const Robot& robot,
                                      const std::filesystem::path& scenarios);

/// Draws figures 3 to 12 of the paper, figure-NN.svg and figure-NN.png, from
/// runs recorded in RUNS/NAME. Throws std::invalid_argument about what it cannot
/// read or write.
std::vector<Figure> DrawFigures(const Robot& robot,
                                const std::filesystem::path& runs,
                                const std::filesystem::path& pictures);

/// Writes the page that shows them, its pictures in the folder `pictures`
/// beside it.
void WriteResults(const std::vector<Figure>& figures,
                  const std::filesystem::path& markdown,
                  const std::string& pictures);

}  // namespace poise
