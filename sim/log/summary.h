// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "poise/robot/robot.h"
#include "poise/sim/run.h"
#include "poise/sim/scenario.h"

namespace poise {

/// Returns summary.json of a run, with the pendulum's bound for one step if it
/// is given, N s: SI units, radians, null for a missing value.
/// `pushes` describes each push. impulse_Ns, push_duration, push_link,
/// push_body and push_point describe the push with the largest impulse.
nlohmann::ordered_json ToJson(const Robot& robot, const Scenario& scenario,
                              const RunResult& result,
                              std::optional<double> step_Ns = {});

/// Returns the summary as a table of some twenty lines for the terminal.
std::string ToTable(const Robot& robot, const Scenario& scenario,
                    const RunResult& result,
                    std::optional<double> step_Ns = {});

}  // namespace poise
