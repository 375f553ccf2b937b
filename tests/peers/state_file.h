// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "poise/robot/control/measurement.h"

namespace poise {

/// Writes consecutive states of one robot into a text file, so that a program
/// without a simulation has the same states to the bit. Throws
/// std::runtime_error if the file cannot be written.
/// pre: states is not empty.
void WriteStates(const std::vector<State>& states, const std::string& path);

/// Reads a file of WriteStates(). Throws std::invalid_argument if it is not
/// one.
std::vector<State> ReadStates(const std::string& path);

}  // namespace poise
