// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <string>

namespace poise {

/// A path that the user typed, meant from where it was typed: `bazel run` moves
/// its program elsewhere, and says in BUILD_WORKING_DIRECTORY from where.
std::filesystem::path UserPath(const std::string& typed);

}  // namespace poise
