// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/package_path.h"

#include <stdexcept>
#include <system_error>

#include "poise/robot/finding.h"
#include "poise/tools/commands/user_path.h"

namespace poise {

void AddPackagePath(CLI::App* app, std::vector<std::string>* folders) {
  app->add_option("--package-path", *folders,
                  "folder in which the packages of package://NAME/... are "
                  "searched for meshes, after the folders above the robot's "
                  "file. May be given several times")
      ->type_name("DIR")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::vector<std::filesystem::path> PackageFolders(
    const std::vector<std::string>& folders) {
  std::vector<std::filesystem::path> paths;
  for (const std::string& folder : folders) {
    paths.push_back(UserPath(folder));
    std::error_code error;
    if (!std::filesystem::is_directory(paths.back(), error)) {
      throw std::invalid_argument("--package-path is " + Quoted(folder) +
                                  ", must be an existing folder");
    }
  }
  return paths;
}

}  // namespace poise
