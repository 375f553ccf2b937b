// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <string>

namespace poise {

/// A file of this text in the folder that the test may write into.
std::filesystem::path TestFile(const std::string& name,
                               const std::string& text);

}  // namespace poise
