// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/profile/profile.h"

namespace poise {

/// The contents of a robot file, and everything in the file that would make the
/// controller fail or compute wrong values. Units are SI.
struct Diagnosis {
  std::string robot;
  std::string root;
  int joints = 0;  ///< Number of movable joints.
  double mass = 0;
  struct Mass {
    std::string link;
    double mass;
  };
  std::vector<Mass> links;   ///< Mass of each link alone.
  std::vector<Mass> bodies;  ///< Links with all links fixed to them.
  struct Sole {
    std::string name, link;
    double length, width;  ///< The sole polygon's, m.
  };
  std::vector<Sole> soles;
  std::optional<double> com_height;  ///< In the standing posture, if any.
  std::optional<double> parity;      ///< See Parity::worst().
  std::vector<Finding> findings;     ///< The most severe first.

  Severity worst() const;
};

/// Examines a robot file. Errors in the robot file become findings. Throws
/// Refusal if the profile does not match the robot.
///
/// Takes less than 10 s and 1 GiB. To limit the time, M is not computed for
/// more than 500 joints. Standing and parity are not examined for more than 100
/// joints, 1000 links or 10000 shapes.
///
/// @param packages  folders of packages with meshes, see FindMesh().
Diagnosis Diagnose(const std::filesystem::path& urdf,
                   const Profile& profile = {},
                   const std::vector<std::filesystem::path>& packages = {});

}  // namespace poise
