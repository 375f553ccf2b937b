// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "poise/tools/commands/doctor/diagnosis.h"

namespace poise {

/// Returns the verdict: "ok", "warn" or "reject".
std::string VerdictWord(const Diagnosis& diagnosis);

/// Returns a text for people, with at most 1000 links and 1000 findings.
std::string WriteTable(const Diagnosis& diagnosis);

/// Returns a JSON document for scripts, with at most 1000 findings: {"verdict",
/// "findings": [{"severity", "where", "what", "why", "line"}], "robot": {...}}.
std::string WriteJson(const Diagnosis& diagnosis);

}  // namespace poise
