// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/sim/run.h"

namespace poise {

/// The facts about one robot in EXPECTED.json.
struct ExpectedRobot {
  bool stands = true;
  /// Names of the links of the feet; empty: not checked.
  std::string left_foot_link, right_foot_link;
  /// Forward axis of the root link, "+x"; empty: not checked.
  std::string forward;
};

/// A folder of URDF files.
struct RobotFolder {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> packages;  ///< Folders of meshes.
  std::string only;  ///< Text that the names of the robots contain.
};

/// The runs of one robot, and where it differs from what is expected.
struct RobotTrial {
  static constexpr std::array<int, 4> kDirections = {0, 90, 180, 270};  // deg.
  /// The first second of `stand` is run with each seed up to this one.
  static constexpr unsigned kSeeds = 6;

  std::string name;     ///< The URDF's name, without folder and ending.
  std::string profile;  ///< Name of the profile's file; empty without one.
  /// Why the robot cannot be simulated; empty if it can.
  std::string refused;
  std::optional<Robot> robot;  ///< Empty if the robot is refused.
  std::string soles;           ///< "box", "mesh", "guess" or "profile".
  std::string forward;         ///< Forward axis of the root link, "+x".
  /// Stands for 10 s, after a start off its equilibrium.
  std::optional<RunResult> stand;
  /// Seeds above 1 with which it falls in the first second of `stand`.
  std::vector<unsigned> fallen_seeds;
  /// Pushed in kDirections; empty if the robot does not stand.
  std::vector<RunResult> pushes;
  std::optional<RunResult> one_leg;  ///< Empty if the robot does not stand.
  /// Why the robot cannot stand on one leg, in words; empty if it can.
  std::string one_leg_obstacle;
  /// Differences from what is expected, in words.
  std::vector<std::string> faults;

  bool stands() const { return stand && stand->verdict.recovered; }
};

/// Impulse of the pushes, as a fraction of lipm_height_Ns.
constexpr double kRobotsPush = 0.4;

/// Reads EXPECTED.json of a folder, by robot. Empty without the file. Throws
/// std::invalid_argument if the file is invalid.
std::map<std::string, ExpectedRobot> ReadExpected(
    const std::filesystem::path& folder);

/// Runs the robots of a folder, several at a time: the scenario `stand`, and
/// its first second with other seeds; a push to each of four sides for 0.1 s;
/// and the scenario `one_leg`. A robot that does not stand is not pushed. A
/// robot uses the profile of FindProfile(). Without one, or if one of
/// robot/profiles does not fit, its feet and posture are found. Warnings are
/// printed on stderr.
///
/// A robot has no faults if it stands, takes the pushes and stands on one leg,
/// except for an obstacle that is known beforehand; and if its feet and its
/// forward axis are the expected ones. If it is expected not to stand, it must
/// be refused or fall. A refused robot that EXPECTED.json does not name has a
/// fault; without EXPECTED.json it has none. A profile that cannot be read is
/// always a fault.
///
/// @param show  is called with each robot, in alphabetical order.
/// Throws std::invalid_argument if the folder has no URDF file, if
/// EXPECTED.json is invalid or names a robot without a file, or if no name
/// contains `only`.
std::vector<RobotTrial> RunRobots(
    const RobotFolder& robots,
    const std::function<void(const RobotTrial&)>& show);

}  // namespace poise
