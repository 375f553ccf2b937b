// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "poise/tools/commands/doctor/diagnosis.h"

namespace poise {

/// Returns the verdict: "ok", "warn" or "reject".
std::string VerdictWord(const Diagnosis& diagnosis);

/// Returns a text for people. Its first ten lines have the verdict, whether the
/// robot stands, the soles, the forward direction, a summary of the warnings,
/// the next step, and what the user must fill in. Findings of one kind share a
/// line that names the first three places. There are at most 1000 lines of
/// links and of findings.
///
/// @param masses  whether to list the mass of each link.
std::string WriteTable(const Diagnosis& diagnosis, bool masses = false);

/// Returns a JSON document for scripts, with at most 1000 findings: {"verdict",
/// "stands", "soles", "forward", "left", "right", "next_step", "findings":
/// [{"severity", "where", "what", "why", "line"}], "robot": {...}}. An
/// unknown value is null: `stands`, a direction or a foot.
std::string WriteJson(const Diagnosis& diagnosis);

}  // namespace poise
