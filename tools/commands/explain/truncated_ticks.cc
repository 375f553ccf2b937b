// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/truncated_ticks.h"

#include <cstdio>
#include <map>

namespace poise {
namespace {

using nlohmann::json;

// Returns the ticks by the first level that was not solved.
std::map<std::string, int> CountByLevel(const RunStory& story) {
  const std::string state = "truncated " + std::string(kLevelReason);
  std::map<std::string, int> ticks;
  for (const Span& span : story.states.spans()) {
    if (span.name.rfind(state, 0) != 0) continue;
    ticks[span.name.substr(state.size())] += span.num_ticks;
  }
  return ticks;
}

// Returns the budget, us, or 0 if there was none.
double FindBudget(const json& summary) {
  const json hqp = summary.value("hqp", json::object());
  if (!hqp.is_object()) return 0;
  const json budget = hqp.value("budget_us", json());
  return budget.is_number() ? budget.get<double>() : 0;
}

}  // namespace

std::string SayTruncated(const RunStory& story, const json& summary) {
  int sum = 0;
  std::string levels;
  for (const auto& [level, ticks] : CountByLevel(story)) {
    levels += (sum == 0 ? ": level " : ", level ") + level + " in " +
              std::to_string(ticks);
    sum += ticks;
  }
  if (sum == 0) return "";
  const json all = summary.value("ticks", json());
  const double budget = FindBudget(summary);
  std::string text = std::to_string(sum);
  if (all.is_number_integer())
    text += " of " + all.dump() + " ticks";
  else
    text += sum == 1 ? " tick" : " ticks";
  text += sum == 1 ? " was" : " were";
  if (budget > 0) {
    char number[32];
    std::snprintf(number, sizeof(number), "%g", budget);
    text += " cut off by the budget of " + std::string(number) +
            " us before all levels were solved";
  } else {
    text += " not solved to the last level";
  }
  text += levels + ".";
  const bool fell = summary.value("fell_at", json()).is_number();
  return budget > 0 && fell ? text + " A larger budget may have helped." : text;
}

}  // namespace poise
