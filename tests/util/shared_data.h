// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace poise {

/// A file or folder of the data that is not in this repository: `sub` in the
/// folder that the environment variable POISE_SHARED names. Nothing where the
/// variable is not set or the data is not there, which the test's output then
/// says; a test must check something without it.
std::optional<std::filesystem::path> SharedData(std::string_view sub);

}  // namespace poise
