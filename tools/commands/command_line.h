// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace poise {

/// Reads a command line into the options of `app`. Throws std::invalid_argument
/// with one line about the first error. An empty word is an error, because an
/// unset shell variable may leave one. If the user requests help, throws the
/// help text, which RunTool() prints.
void ParseCommandLine(int argc, char** argv, CLI::App* app);

/// Runs `body` as the main() of a command and returns its exit code. If `body`
/// throws a std::exception, or stdout cannot be written, prints one line on
/// stderr and returns 2. If ParseCommandLine() throws the help text, prints it
/// and returns 0. Calls SayIfInterrupted().
int RunTool(const std::string& name, const std::function<int()>& body);

}  // namespace poise
