// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "robot/robot.h"

namespace poise {

/// Reads a robot from a URDF file.
///
/// The root link is the floating base, massless or not, also where it is called
/// `world`; a massless root that carries nothing but one joint of type
/// `floating` is left out, and its child is the base. Mimic joints are joints
/// like others (RobotModel::mimics says what they follow). A link without
/// `<inertial>` has no mass. Meshes are named, never opened. Numbers are read
/// the same in every locale.
///
/// @param locked  joints to fix, by name, at a value in rad or m: the tree is
///                the reduced one, their links stay as frames.
///
/// Throws std::invalid_argument with one line that names the file, the element,
/// its value and what was wanted.
RobotModel LoadUrdf(const std::filesystem::path& file,
                    const std::map<std::string, double>& locked = {});

}  // namespace poise
