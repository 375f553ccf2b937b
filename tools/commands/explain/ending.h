// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace poise {

/// Returns a number of summary.json; nothing if there is no such number.
std::optional<double> NumberIn(const nlohmann::json& summary, const char* key);

/// Returns true if the run was stopped before the robot fell, so that its
/// outcome is unknown.
/// @param summary  summary.json.
bool WasInterrupted(const nlohmann::json& summary);

/// Returns true if the push was far larger than what the robot can recover from
/// with steps, so that nothing but a smaller push would have helped.
bool IsBeyondSteps(const nlohmann::json& summary);

/// Returns a sentence, behind a space, that names a setting of the run with
/// which the robot may have fallen: noise, or a task that was switched off
/// although it prevents such falls. The run does not show whether the robot
/// would have recovered with another setting. Returns an empty text if there is
/// no such setting.
std::string SuspectSetting(const nlohmann::json& summary);

/// Returns the sentence about the outcome of a run, with SuspectSetting() if
/// the robot fell.
std::string Ending(const nlohmann::json& summary);

}  // namespace poise
