// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "poise/tools/commands/explain/run_story.h"

namespace poise {

/// The beginning of the reason of a truncated tick in log.csv. The number of
/// the first level that was not solved follows.
inline constexpr std::string_view kLevelReason = "rank_";

/// Returns a sentence about the ticks that were not solved to the last level,
/// by level, or an empty text if there are none. It names the budget, and
/// advises a larger one if the robot fell after such a tick.
/// @param summary  summary.json; may lack any key.
std::string SayTruncated(const RunStory& story, const nlohmann::json& summary);

}  // namespace poise
