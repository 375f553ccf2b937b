// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/froude.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "poise/dynamics/tick.h"
#include "poise/dynamics/tree.h"
#include "poise/robot/nominal_tick.h"

namespace poise {
namespace {

// Largest relative difference of the heights or the masses of one robot:
// rounding, and postures that differ a little.
constexpr double kSameHeight = 1e-3;

// Returns the power of L of a parameter, from its unit: 1 for m, 0.5 for s,
// -0.5 for 1/s, -1 for 1/s2, -1.5 for 1/s3, -2 for 1/m2, and 0 for numbers
// without a unit.
double PowerOf(std::string_view task, std::string_view parameter) {
  static const std::map<std::string_view, double> powers = {
      {"angular_weight", -2},
      {"capture_angular_weight", -2},
      {"capture_kd", -0.5},
      {"capture_kp", -1},
      {"capture_margin", 1},
      {"dx", 1},
      {"dy", 1},
      {"horizon", 0.5},
      {"kd", -0.5},
      {"kd_angular", -0.5},
      {"ki", -1.5},
      {"ki_height", -1.5},
      {"kp", -1},
      {"margin", 1},
      {"omega", -0.5},
      {"radius", 1},
      {"step_kd", -0.5},
      {"step_kp", -1}};
  if (task == "self_collision") return 0;
  if (task == "joint_limits" && parameter == "margin") return 0;  // rad.
  const auto found = powers.find(parameter);
  return found == powers.end() ? 0 : found->second;
}

}  // namespace

std::optional<double> NominalComHeight(const Robot& robot) {
  const Tree& tree = robot.model.tree;
  if (robot.feet.empty() || robot.q_nominal.size() != tree.nq()) {
    return std::nullopt;
  }
  const Tick tick = NominalTick(robot);
  double ground = 0;
  for (const Foot& foot : robot.feet) {
    ground += (tick.X_WB[foot.body] * foot.X_BC).p.z();
  }
  return tick.p_WG.z() - ground / static_cast<double>(robot.feet.size());
}

FroudeScale MakeFroudeScale(const Robot& robot) {
  const auto ratio = [](double value, double tuned) {
    const double exact = value / tuned;
    return exact > 0 && std::abs(exact - 1) >= kSameHeight ? exact : 1;
  };
  return {ratio(NominalComHeight(robot).value_or(0), kTunedComHeight),
          ratio(robot.model.tree.total_mass(), kTunedMass)};
}

void ScaleToHeight(double com_height, const Task& task) {
  const double length = com_height / kTunedComHeight;
  if (std::abs(length - 1) < kSameHeight) return;
  for (const Parameter& parameter : task.parameters()) {
    const double scaled =
        *parameter.value *
        std::pow(length, PowerOf(task.name(), parameter.name));
    *parameter.value = std::clamp(scaled, parameter.lower, parameter.upper);
  }
}

}  // namespace poise
