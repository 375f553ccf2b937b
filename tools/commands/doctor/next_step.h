// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "poise/tools/commands/doctor/diagnosis.h"

namespace poise {

/// Where the user asks, and so which commands the answer may have.
enum class Caller { kShell, kPython };

/// The arguments of the command as the user typed them.
struct Arguments {
  std::string file;
  std::string profile;                ///< Empty: none.
  std::vector<std::string> packages;  ///< Values of --package-path.
  Caller caller = Caller::kShell;
};

/// Returns what to do next, in one line that has the exact command or call.
std::string NextStep(const Diagnosis& diagnosis, const Arguments& arguments);

/// Returns the lines of the profile that the user must correct, with the guess
/// in them: the soles that are estimated, or both feet if none were found.
/// Returns nothing if there is nothing to correct.
std::vector<std::string> ProfileStub(const Diagnosis& diagnosis);

}  // namespace poise
