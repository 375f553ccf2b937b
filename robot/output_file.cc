// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace poise {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Throw(const fs::path& path, const std::string& why,
                        const std::error_code& reason) {
  throw std::invalid_argument(path.string() + ": " + why + ": " +
                              reason.message());
}

// Requires that files can be written in a folder that exists.
void RequireWritableFolder(const fs::path& folder, const fs::path& named) {
  if (access(folder.c_str(), W_OK | X_OK) != 0) ThrowNotWritten(named);
}

}  // namespace

void WriteFile(const fs::path& file, std::string_view text) {
  std::error_code error;
  const bool is_device = fs::exists(file, error) && !fs::is_regular_file(file);
  // A pipe must be opened once only: its reader may stop when it is closed.
  if (!is_device) RequireWritable(file);
  // A link stays a link.
  fs::path target = is_device ? file : fs::weakly_canonical(file, error);
  if (error) Throw(file, "cannot be written", error);
  fs::path draft = target;
  if (!is_device) draft += ".new";
  std::ofstream stream(draft, std::ios::binary);
  stream << text;
  if (!stream.flush()) {
    const std::error_code reason(errno, std::generic_category());
    if (!is_device) fs::remove(draft, error);
    Throw(file, "cannot be written", reason);
  }
  stream.close();
  if (is_device) return;
  fs::rename(draft, target, error);
  if (error) Throw(file, "cannot be written", error);
}

void MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder)) {
    error = std::make_error_code(std::errc::not_a_directory);
  }
  if (error) Throw(folder, "cannot be made a folder", error);
  RequireWritableFolder(folder, folder);
}

void RequireWritable(const fs::path& file) {
  std::error_code error;
  if (fs::exists(file, error)) {
    // This does not shorten the file.
    if (!std::ofstream(file, std::ios::app)) ThrowNotWritten(file);
    return;
  }
  const fs::path folder =
      file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (fs::is_directory(folder, error)) RequireWritableFolder(folder, file);
}

void ThrowNotWritten(const fs::path& file) {
  Throw(file, "cannot be written",
        std::error_code(errno, std::generic_category()));
}

}  // namespace poise
