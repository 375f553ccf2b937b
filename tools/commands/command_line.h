// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace poise {

/// Reads a command line. Throws std::invalid_argument with one line about what
/// does not fit; an empty word, as an unset variable of a shell leaves it, fits
/// nowhere. Where help is asked for, throws that too: for RunTool().
void ParseCommandLine(int argc, char** argv, CLI::App* app);

/// The main() of a command: its exit code is that of `body`. What that throws
/// becomes one line on stderr and exit code 2, and so does output that could not
/// be written; help is printed, with exit code 0.
int RunTool(const std::string& name, const std::function<int()>& body);

}  // namespace poise
