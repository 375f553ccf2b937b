// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "poise/tools/commands/doctor/diagnosis.h"

namespace poise {

/// The arguments of the command as the user typed them.
struct Arguments {
  std::string file;
  std::string profile;                ///< Empty: none.
  std::vector<std::string> packages;  ///< Values of --package-path.
};

/// Returns what to do next, in one line that has the exact command.
std::string NextStep(const Diagnosis& diagnosis, const Arguments& arguments);

/// Returns the lines of the profile that the user must correct, with the guess
/// in them: the soles that are estimated, or both feet if none were found.
/// Returns nothing if there is nothing to correct.
std::vector<std::string> ProfileStub(const Diagnosis& diagnosis);

}  // namespace poise
