// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <string_view>

namespace poise {

/// Makes `text` the content of a file. Throws std::invalid_argument with the
/// name of the file and the system's reason if the file cannot be written.
///
/// The file is replaced in one step: a reader, or an interrupted program, sees
/// either the old file or the new one, and the old one stays if the new one
/// does not fit. The owner and the permissions stay. A link stays a link; the
/// file that it names is written. Some files cannot be replaced and are written
/// directly instead: a device, a pipe, a mount point, a file with several hard
/// links or of another owner, and a file in a folder where no file can be
/// created. A program that is killed may leave a file FILE.PID-0.
void WriteFile(const std::filesystem::path& file, std::string_view text);

/// Makes a folder, and those above, if they do not exist. Throws
/// std::invalid_argument with the name of the folder and the system's reason if
/// there can be no such folder, or if no file can be written there.
void MakeFolder(const std::filesystem::path& folder);

/// Throws std::invalid_argument with the name of a file and the system's reason
/// if the file cannot be written. Changes nothing: does not create the file,
/// and does not shorten it. A file in a folder that does not exist is accepted.
void RequireWritable(const std::filesystem::path& file);

/// Throws std::invalid_argument with the name of a file and the system's
/// reason. Must be called directly after the attempt to open or write the file,
/// because the reason is in errno.
[[noreturn]] void ThrowNotWritten(const std::filesystem::path& file);

}  // namespace poise
