// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "robot/finding.h"
#include "robot/robot.h"

namespace poise {

/// Reads a robot from a URDF file.
///
/// The root link is the floating base, massless or not, also where it is called
/// `world`; massless links from the root down to a joint of type `floating`
/// stand for the world and are left out. Mimic joints are joints
/// like others (RobotModel::mimics says what they follow). A link without
/// `<inertial>` has no mass. Meshes are named, never opened. Numbers are read
/// the same in every locale.
///
/// @param locked  joints to fix, by name, at a value in rad or m: the tree is
///                the reduced one, their links stay as frames.
///
/// @param findings  where not null, all that is odd about the file is added, and
///                  all that is wrong before it is thrown.
///
/// Throws Refusal with one line that names the file, the element, its value and
/// what was wanted. Any file takes less than 10 s and 1 GiB.
/// Costs O(n log n) in the length of the file.
RobotModel LoadUrdf(const std::filesystem::path& file,
                    const std::map<std::string, double>& locked = {},
                    std::vector<Finding>* findings = nullptr);

/// The same from a URDF's text.
///
/// @param source  what to call it in a message.
RobotModel ParseUrdf(std::string_view text, const std::string& source,
                     const std::map<std::string, double>& locked = {},
                     std::vector<Finding>* findings = nullptr);

/// The mass of each link, kg, where RobotModel::tree has those of bodies.
/// @pre LoadUrdf() reads the file.
std::map<std::string, double> LoadLinkMasses(const std::filesystem::path& file);

}  // namespace poise
