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
  std::string name;  ///< Name of its folder.
  Experiment experiment;
};

/// A figure of the paper and our counterpart.
struct Figure {
  int number;
  std::string caption;
  std::string paper;  ///< Describes the paper's figure.
  std::string ours;   ///< Describes our figure, with numbers.
};

/// Returns the runs of a robot that the figures need. The scenarios are read
/// from a folder.
std::vector<FigureRun> MakeFigureRuns(const Robot& robot,
                                      const std::filesystem::path& scenarios);

/// Draws figures 3 to 12 of the paper, figure-NN.svg and figure-NN.png, from
/// runs recorded in RUNS/NAME. Throws std::invalid_argument if a file cannot be
/// read or written.
std::vector<Figure> DrawFigures(const Robot& robot,
                                const std::filesystem::path& runs,
                                const std::filesystem::path& pictures);

/// Writes the page that shows the figures. Their pictures are in the folder
/// `pictures` next to the page.
void WriteResults(const std::vector<Figure>& figures,
                  const std::filesystem::path& markdown,
                  const std::string& pictures);

}  // namespace poise
