// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "poise/tools/commands/explain/run_story.h"

namespace poise {

/// The most sentences of a story.
constexpr size_t kStoryLength = 6;

/// What a run is about, in order of cause: the push, the first cause, what the
/// momentum lost by it, the ending, and what would have helped after a fall.
///
/// @param summary  of the run; an empty object if there is none.
/// @param notes    sentences that must be said, too.
/// @param ending   sentence on how the run ended.
/// Returns at most kStoryLength sentences.
std::vector<std::string> TellShortStory(const RunStory& story,
                                        const nlohmann::json& summary,
                                        const std::vector<std::string>& notes,
                                        const std::string& ending);

}  // namespace poise
