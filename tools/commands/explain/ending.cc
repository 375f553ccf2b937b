// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/ending.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "poise/sim/judge.h"
#include "poise/tools/commands/format.h"

namespace poise {
namespace {

using nlohmann::json;

constexpr double kRounding = 1e-6;  // s, rounding of a sum of ticks.
// Beyond this multiple of the bound with one step, or of that without a step if
// it is larger, no step helps. Our humanoid recovers from at most 1.15 times
// the bound with one step, with several steps (docs/generated/step_map.md).
constexpr double kBeyondSteps = 2;

// Returns whether summary.tasks.LIST has the task.
bool HasTask(const json& summary, const char* list, const char* task) {
  const json tasks = summary.value("tasks", json());
  const json names = tasks.is_object() ? tasks.value(list, json()) : json();
  return std::find(names.begin(), names.end(), task) != names.end();
}

std::string FellBy(const json& summary) {
  const json by = summary.value("fell_by", json());
  return by.is_string() ? by.get<std::string>() : "";
}

}  // namespace

std::optional<double> NumberIn(const json& summary, const char* key) {
  const auto at = summary.find(key);
  if (at == summary.end() || !at->is_number()) return std::nullopt;
  return at->get<double>();
}

bool WasInterrupted(const json& summary) {
  return summary.value("interrupted", json()) == true &&
         !summary.value("fell_at", json()).is_number();
}

bool IsBeyondSteps(const json& summary) {
  const auto impulse = NumberIn(summary, "impulse_Ns");
  const auto bearable = NumberIn(summary, "lipm_height_Ns");
  const auto with_step = NumberIn(summary, "step_Ns");
  // The bound is 0 if the legs cannot reach a place for a step.
  return impulse && bearable && with_step &&
         *impulse > kBeyondSteps * std::max(*bearable, *with_step);
}

std::string SuspectSetting(const json& summary) {
  if (IsBeyondSteps(summary)) return "";
  constexpr double kUsual = 1;
  const double noise = NumberIn(summary, "sensor_noise").value_or(0);
  if (noise > kUsual) {
    return Format(
        " The sensors had %.3g times the usual noise: with less, the robot may "
        "recover.",
        noise);
  }
  const std::string fell_by = FellBy(summary);
  const auto is_off = [&](const char* task) {
    return HasTask(summary, "without", task);
  };
  const bool limits_cop = HasTask(summary, "with", "zmp") ||
                          HasTask(summary, "with", "zmp_literal");
  if (fell_by.find("tilted") != std::string::npos && is_off("cop") &&
      !limits_cop) {
    return " The task `cop` was switched off, which keeps the CoP inside the "
           "soles: with it, the robot may recover.";
  }
  if (fell_by.find("slid") != std::string::npos && is_off("friction")) {
    return " The task `friction` was switched off, which keeps the forces "
           "inside the friction cones: with it, the robot may recover.";
  }
  return "";
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
  if (recovered == true) {
    return summary.value("commanded_done", json()) == false
               ? "The robot recovered, but the commanded motion did not happen."
               : "The robot recovered.";
  }
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
  const std::string why = FellBy(summary);
  return "The robot fell at " + Format("%.3f s", fell_at.get<double>()) +
         (why.empty() ? "" : ": " + why) + "." + SuspectSetting(summary);
}

}  // namespace poise
