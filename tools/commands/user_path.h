// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <string>

namespace poise {

/// Resolves a path that the user typed, relative to the folder where the user
/// typed it. `bazel run` starts a program in another folder, and passes the
/// user's folder in BUILD_WORKING_DIRECTORY.
std::filesystem::path UserPath(const std::string& typed);

}  // namespace poise
