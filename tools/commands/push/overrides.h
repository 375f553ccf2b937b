// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "poise/sim/scenario.h"

namespace poise {

/// The options of `push` that replace settings of a scenario. An option that is
/// not given changes nothing.
struct Overrides {
  std::optional<double> force, impulse_fraction, direction, duration, at, time,
      control_rate, plant_rate, mu_plant, mass_error, torque_scale, noise,
      delay, ramp, budget_us;
  std::optional<std::string> link, tasks, friction, plant, pushes, steps;
  std::vector<double> point, freeze;
  std::vector<std::string> with, without;
  bool weighted = false, feedforward = false, estimator = false;
  std::optional<bool> budget_clock;
  std::optional<unsigned> seed;
};

/// Adds the options to an application, which writes their values to *overrides.
void AddOptions(CLI::App* app, Overrides* overrides);

/// Throws std::invalid_argument if --with and --without name the same task.
void RefuseBoth(const std::vector<std::string>& with,
                const std::vector<std::string>& without);

/// Writes the given options into a scenario. The options about a push change
/// the first push of the scenario, or add a push if there is none. Throws
/// std::invalid_argument if the file of pushes is invalid or options contradict
/// each other, and InputError if the direction is out of range.
void Apply(const Overrides& overrides, Scenario* scenario);

}  // namespace poise
