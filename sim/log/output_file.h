// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>

namespace poise {

/// Throws std::invalid_argument with the name of a file and the system's reason
/// if the file cannot be written. Changes nothing: does not create the file, and
/// does not shorten it. A file in a folder that does not exist is accepted.
void RequireWritable(const std::filesystem::path& file);

/// Throws std::invalid_argument with the name of a file and the system's reason.
/// Must be called directly after the attempt to open or write the file, because
/// the reason is in errno.
[[noreturn]] void ThrowNotWritten(const std::filesystem::path& file);

}  // namespace poise
