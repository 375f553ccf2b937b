// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace poise {

void RequireWritable(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error)) {
    // This does not shorten the file.
    if (!std::ofstream(file, std::ios::app)) {
      ThrowNotWritten(file);
    }
    return;
  }
  std::filesystem::path folder = file.parent_path();
  if (folder.empty()) folder = ".";
  if (std::filesystem::is_directory(folder, error) &&
      access(folder.c_str(), W_OK | X_OK) != 0) {
    ThrowNotWritten(file);
  }
}

void ThrowNotWritten(const std::filesystem::path& file) {
  const std::error_code reason(errno, std::generic_category());
  throw std::invalid_argument(file.string() +
                              ": cannot be written: " + reason.message());
}

}  // namespace poise
