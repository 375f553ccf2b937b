// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace poise {

/// A file that a command reads.
struct InputFile {
  std::filesystem::path file;  ///< Empty if the user did not give this file.
  std::string name;            ///< In words, such as "the robot's file".
};

/// Throws std::invalid_argument if the output of a command would replace one of
/// the files that the command reads. Finds the file also by another spelling of
/// its path, and by a link.
///
/// @param typed  the output as the user typed it, see UserPath(). If empty, the
///               function does nothing.
void KeepInputs(const std::string& typed, const std::vector<InputFile>& inputs);

}  // namespace poise
