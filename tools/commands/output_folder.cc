// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/output_folder.h"

#include "poise/robot/output_file.h"
#include "poise/tools/commands/user_path.h"

namespace poise {

std::filesystem::path MakeOutputFolder(const std::string& out) {
  std::filesystem::path folder = UserPath(out);
  MakeFolder(folder);
  return folder;
}

}  // namespace poise
