// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/profile/profile.h"

namespace poise {

/// What a robot file says, and everything in it that would make control fail or
/// lie.
struct Diagnosis {
  std::string robot;
  std::string root;
  int joints = 0;  ///< That move.
  double mass = 0;
  struct Mass {
    std::string link;
    double mass;
  };
  std::vector<Mass> links;   ///< Each link alone.
  std::vector<Mass> bodies;  ///< With all that is fixed to them.
  struct Sole {
    std::string name, link;
    double length, width;
  };
  std::vector<Sole> soles;
  std::optional<double> com_height;  ///< In its standing posture, if it stands.
  std::optional<double> parity;      ///< With Bullet: the worst, relative.
  std::vector<Finding> findings;     ///< The worst first.

  Severity worst() const;
};

/// Looks a robot file over. Throws Refusal where the profile does not fit the
/// robot, and never for what the robot's own file may hold; takes less
/// than 10 s and 1 GiB: above 500 joints M is not computed; above 100, or 1000
/// links or 10000 shapes, the robot is not stood up.
Diagnosis Diagnose(const std::filesystem::path& urdf,
                   const Profile& profile = {});

}  // namespace poise
