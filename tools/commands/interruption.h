// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

namespace poise {

// The user interrupts a program by SIGINT (Ctrl-C) or SIGTERM (kill).

/// From now on, prints "NAME: interrupted" when the user interrupts the program
/// and ends it. A signal that the program ignores, as one in the background
/// may, stays ignored.
void SayIfInterrupted(const std::string& name);

/// From now on, the program does not end when the user interrupts it, but
/// IsInterrupted() returns true. The second time ends the program. A program in
/// the background is interrupted as well.
void CatchInterruption();

/// Returns true if the user has interrupted the program since
/// CatchInterruption().
bool IsInterrupted();

}  // namespace poise
