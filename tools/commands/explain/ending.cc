// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/ending.h"

#include <algorithm>
#include <cmath>

#include "poise/sim/judge.h"
#include "poise/tools/commands/format.h"

namespace poise {
namespace {

using nlohmann::json;

constexpr double kRounding = 1e-6;  // s, rounding of a sum of ticks.

// Returns whether summary.tasks.LIST has the task.
bool HasTask(const json& summary, const char* list, const char* task) {
  const json tasks = summary.value("tasks", json());
  const json names = tasks.is_object() ? tasks.value(list, json()) : json();
  return std::find(names.begin(), names.end(), task) != names.end();
}

// Returns a sentence if the run has switched off the task that prevents such a
// fall.
std::string SayMissingTask(const json& summary, const std::string& fell_by) {
  const auto is_off = [&](const char* task) {
    return HasTask(summary, "without", task);
  };
  const bool limits_cop = HasTask(summary, "with", "zmp") ||
                          HasTask(summary, "with", "zmp_literal");
  if (fell_by.find("tilted") != std::string::npos && is_off("cop") &&
      !limits_cop) {
    return " No task kept the CoP inside the soles: `cop` was switched off.";
  }
  if (fell_by.find("slid") != std::string::npos && is_off("friction")) {
    return " No task kept the forces inside the friction cones: `friction` was "
           "switched off.";
  }
  return "";
}

}  // namespace

bool WasInterrupted(const json& summary) {
  return summary.value("interrupted", json()) == true &&
         !summary.value("fell_at", json()).is_number();
}

std::string Ending(const json& summary) {
  if (WasInterrupted(summary)) {
    const json at = summary.value("duration", json());
    return "The run was interrupted" +
           (at.is_number() ? Format(" at %.3f s", at.get<double>()) : "") +
           " while the robot was still standing: the outcome is not known.";
  }
  const json recovered = summary.value("recovered", json());
  if (recovered.is_null()) return "The end of the run is not recorded.";
  if (recovered == true) return "The robot recovered.";
  const json fell_at = summary.value("fell_at", json());
  if (!fell_at.is_number()) {
    const json after = summary.value("time_after_push", json());
    if (after.is_number() && after < Judge::kEnd - kRounding) {
      return Format("The run ends %.3g s", std::abs(after.get<double>())) +
             (after < 0 ? " before" : " after") +
             " the end of the push: too early to tell whether the robot "
             "recovers.";
    }
    return "The robot did not fall, but did not return to its reference.";
  }
  const json by = summary.value("fell_by", json());
  const std::string why = by.is_string() ? by.get<std::string>() : "";
  return "The robot fell at " + Format("%.3f s", fell_at.get<double>()) +
         (why.empty() ? "" : ": " + why) + "." + SayMissingTask(summary, why);
}

}  // namespace poise
