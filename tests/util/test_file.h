// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <string>

namespace poise {

/// Writes a file with this text into the test's temporary folder. Returns its
/// path.
std::filesystem::path TestFile(const std::string& name,
                               const std::string& text);

}  // namespace poise
