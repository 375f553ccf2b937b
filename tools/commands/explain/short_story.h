// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "poise/tools/commands/explain/run_story.h"

namespace poise {

/// Maximum number of sentences of a story.
constexpr size_t kStoryLength = 6;

/// Summarizes a run in order of time: the pushes, the first cause, the momentum
/// lost because of it, and the end of the run. After a fall, adds what would
/// have helped. Returns at most kStoryLength sentences.
///
/// @param summary  summary of the run; an empty object if there is none. Then
///                 the story has a sentence less, and the caller says first
///                 that there is no summary.
/// @param notes    sentences that the result must contain.
/// @param ending   sentence about the end of the run.
std::vector<std::string> TellShortStory(const RunStory& story,
                                        const nlohmann::json& summary,
                                        const std::vector<std::string>& notes,
                                        const std::string& ending);

}  // namespace poise
