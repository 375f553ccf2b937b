// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/fit_to_robot.h"

#include <algorithm>
#include <cmath>

#include "poise/robot/control/stance.h"
#include "poise/sim/observation.h"
#include "poise/sim/plants/plant_settings.h"

namespace poise {
namespace {

// A robot is the one of chosen_for if its mass and its height are this near to
// the file's numbers, which are rounded.
constexpr double kNear = 0.01;

bool IsNear(double value, double wanted) {
  return std::abs(value - wanted) <= kNear * wanted;
}

void ScaleLengths(double ratio, Scenario* scenario) {
  scenario->start.drop *= ratio;
  scenario->com.sine *= ratio;
  scenario->com.cosine *= ratio;
  for (StanceEvent& event : scenario->stance) {
    event.height = std::clamp(ratio * event.height, Stance::kLeastHeight,
                              Stance::kMostHeight);
  }
  for (Board& board : scenario->plant.ground.boards) {
    board.center_W *= ratio;
    board.size *= ratio;
  }
}

}  // namespace

Scenario FitToRobot(const Robot& robot, Scenario scenario) {
  double ratio = 1;
  bool is_chosen = false;
  if (scenario.chosen_for) {
    const double height = StandingHeight(robot);
    is_chosen =
        IsNear(robot.model.tree.total_mass(), scenario.chosen_for->mass) &&
        IsNear(height, scenario.chosen_for->com_height);
    ratio = height / scenario.chosen_for->com_height;
  }
  if (scenario.chosen_for && !is_chosen) ScaleLengths(ratio, &scenario);
  for (Push& push : scenario.pushes) {
    if (push.elsewhere && !is_chosen) push.impulse_fraction = push.elsewhere;
    push.elsewhere.reset();
  }
  scenario.chosen_for.reset();
  return scenario;
}

}  // namespace poise
