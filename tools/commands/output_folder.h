// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <string>

namespace poise {

/// Makes the folder that the option --out names, and those above, if they do
/// not exist. A program does this before a long computation. Returns the path,
/// see UserPath().
///
/// Throws std::invalid_argument with the reason if there can be no such folder,
/// or if no file can be written there.
std::filesystem::path MakeOutputFolder(const std::string& out);

}  // namespace poise
