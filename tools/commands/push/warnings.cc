// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push/warnings.h"

#include <algorithm>
#include <iostream>
#include <utility>

#include "poise/robot/control/judge_legs.h"
#include "poise/tools/commands/doctor/strength.h"

namespace poise {
namespace {

constexpr size_t kMostLines = 5;
constexpr size_t kMostNames = 3;

}  // namespace

std::vector<std::string> WarningLines(const std::string& file,
                                      const std::vector<Finding>& findings) {
  // Findings with the same reason are of one kind.
  std::vector<std::vector<const Finding*>> kinds;
  for (const Finding& finding : findings) {
    if (finding.severity != Severity::kWarn) continue;
    const auto kind = std::find_if(
        kinds.begin(), kinds.end(),
        [&](const auto& each) { return each[0]->why == finding.why; });
    if (kind == kinds.end()) {
      kinds.push_back({&finding});
    } else {
      kind->push_back(&finding);
    }
  }
  std::vector<std::string> lines;
  for (const auto& kind : kinds) {
    if (lines.size() == kMostLines) {
      lines.push_back(file + ": " + std::to_string(kinds.size() - kMostLines) +
                      " more kinds of warnings, see bazel run //tools:doctor");
      break;
    }
    std::string line = Message(file, *kind[0]);
    for (size_t i = 1; i < std::min(kind.size(), 1 + kMostNames); ++i) {
      line += (i == 1 ? "; also " : ", ") + OneLine(kind[i]->where);
    }
    if (kind.size() > 1 + kMostNames) {
      line += " and " + std::to_string(kind.size() - 1 - kMostNames) + " more";
    }
    lines.push_back(line);
  }
  return lines;
}

void PrintWarnings(const std::string& file, const Robot& robot,
                   std::vector<Finding> findings) {
  for (auto* judge : {&JudgeLegs, &FindWeakness}) {
    for (Finding& finding : judge(robot)) {
      findings.push_back(std::move(finding));
    }
  }
  for (const std::string& line : WarningLines(file, findings)) {
    std::cerr << line << "\n";
  }
}

std::string BudgetWarning(const ControlSettings& control) {
  constexpr double kShare = 1.0 / 3;  // See docs/failures.md.
  const double period_us = 1e6 * control.dt;
  if (control.budget_us <= kShare * period_us) return "";
  return "the budget is " + PrintNumber(control.budget_us) +
         " us, more than a third of the control period, " +
         PrintNumber(period_us) +
         " us: on a robot, a tick may end late, see docs/failures.md";
}

}  // namespace poise
