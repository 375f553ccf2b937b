// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace poise {

/// Adds the option --package-path DIR to a command. It may be given several
/// times.
///
/// @param folders  receives the folders as typed. Must live until the command
///                 line is parsed.
void AddPackagePath(CLI::App* app, std::vector<std::string>* folders);

/// Returns the folders that the option gave, see UserPath(). Throws
/// std::invalid_argument if a folder does not exist.
std::vector<std::filesystem::path> PackageFolders(
    const std::vector<std::string>& folders);

}  // namespace poise
