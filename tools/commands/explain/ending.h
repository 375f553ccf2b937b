// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace poise {

/// Returns true if the run was stopped before the robot fell, so that its
/// outcome is unknown.
/// @param summary  summary.json.
bool WasInterrupted(const nlohmann::json& summary);

/// Returns the sentence about the outcome of a run. If the robot fell, a second
/// one names the task that the run had switched off and that prevents such a
/// fall.
std::string Ending(const nlohmann::json& summary);

}  // namespace poise
