// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "poise/python/python_tree.h"
#include "poise/robot/finding.h"
#include "poise/robot/profile/profile.h"
#include "poise/robot/robot.h"

namespace poise {

/// A robot with the files that it was made from. A robot never changes after it
/// is loaded, so several threads may use it.
struct PythonRobot {
  std::shared_ptr<const Robot> robot;
  Profile profile;
  std::string urdf;
  std::string profile_file;  ///< Empty: none.
  std::vector<std::string> packages;
  std::vector<Finding> findings;
  std::shared_ptr<PythonTree> tree;  ///< Shares the robot's tree.
};

using RobotClass = pybind11::class_<PythonRobot, std::shared_ptr<PythonRobot>>;

/// Adds the method doctor() to Robot.
void AddDoctor(RobotClass* robot);

/// Sets the folder of Poise's own robot, profile and scenarios.
void SetDataFolder(const std::filesystem::path& folder);
const std::filesystem::path& DataFolder();

}  // namespace poise
