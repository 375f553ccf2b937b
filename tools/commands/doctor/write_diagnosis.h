// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "poise/tools/commands/doctor/diagnosis.h"

namespace poise {

/// "ok", "warn" or "reject".
std::string VerdictWord(const Diagnosis& diagnosis);

/// For a person, at most 1000 findings.
std::string WriteTable(const Diagnosis& diagnosis);

/// For a script: {"verdict", "findings": [{"severity", "where", "what", "why",
/// "line"}], "robot": {...}}, at most 1000 findings.
std::string WriteJson(const Diagnosis& diagnosis);

}  // namespace poise
