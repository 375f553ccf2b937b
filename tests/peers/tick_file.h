// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "poise/tests/util/recorded_ticks.h"

namespace poise {

/// Writes recorded ticks as a binary file, with the numbers of this machine. A
/// file is read only on the machine that wrote it. Throws std::runtime_error if
/// the file cannot be written.
void WriteTicks(const RecordedTicks& recorded, const std::string& path);

/// Reads a file of WriteTicks(), with the same bits. Throws
/// std::invalid_argument if the file cannot be read, is of another format or
/// ends early.
RecordedTicks ReadTicks(const std::string& path);

}  // namespace poise
