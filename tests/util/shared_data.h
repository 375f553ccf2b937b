// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace poise {

/// Returns a file or folder of data that is not in this repository: `sub` in
/// the folder that the environment variable POISE_SHARED names. If the variable
/// is not set or the data does not exist, prints a note and returns nothing. A
/// test must check something without the data as well.
std::optional<std::filesystem::path> SharedData(std::string_view sub);

}  // namespace poise
