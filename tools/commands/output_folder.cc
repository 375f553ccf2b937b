// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/output_folder.h"

#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "poise/robot/finding.h"
#include "poise/tools/commands/user_path.h"

namespace poise {

std::filesystem::path MakeOutputFolder(const std::string& out) {
  std::filesystem::path folder = UserPath(out);
  const auto refuse = [&](const std::string& why,
                          const std::error_code& error) {
    throw std::invalid_argument("--out is " + Quoted(out) + ", which " + why +
                                ": " + error.message());
  };
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && !std::filesystem::is_directory(folder)) {
    error = std::make_error_code(std::errc::not_a_directory);
  }
  if (error) refuse("cannot be made a folder", error);
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    refuse("cannot be written", {errno, std::generic_category()});
  }
  return folder;
}

}  // namespace poise
