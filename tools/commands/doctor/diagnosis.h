// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "poise/robot/finding.h"

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
    double length, width;  ///< Sides around the sole polygon, m.
    /// Pose of the sole's middle in the link: m, and roll, pitch, yaw, rad.
    Eigen::Vector3d xyz = Eigen::Vector3d::Zero();
    Eigen::Vector3d rpy = Eigen::Vector3d::Zero();
    /// "box", "mesh" or "guess", or "profile" if the profile gives the sole.
    std::string from = "profile";
    double depth = 0;  ///< Height of the foot's origin above the sole, m.
  };
  std::vector<Sole> soles;  ///< The left one first.
  /// A guess of the feet, if none were found: the two lowest links.
  std::vector<Sole> guessed_feet;
  /// Whether it is known if the robot stands. False if the robot is too large,
  /// if its simulation takes too long, or if the file is rejected.
  bool was_tested = false;
  /// Whether the robot stands: it has a standing posture and stays up in the
  /// scenario `stand`, simulated for 1 s, or for 5 s if a motor is weak or
  /// missing. If the simulation takes too long, a note says so.
  bool stands = false;
  std::string reason;  ///< Why it does not stand, or was not tested.
  std::string remedy;  ///< The part to correct so that it stands, or "".
  bool has_many_legs = false;  ///< It has more legs than two.
  std::string forward;         ///< Axis of the root link: "+x", ..., or "".
  std::string profile;         ///< The profile that was found, as YAML.
  std::string next_step;       ///< See NextStep(). The caller writes it.
  bool is_xacro = false;       ///< The file must be expanded with xacro.
  std::optional<double> com_height;  ///< In the standing posture, if any.
  std::optional<double> parity;      ///< See Parity::worst().
  std::vector<Finding> findings;     ///< The most severe first.

  Severity worst() const;
};

}  // namespace poise
