// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "poise/math/pose.h"
#include "poise/robot/feet/sole_source.h"
#include "poise/robot/profile/profile_reader.h"

namespace poise {

/// The description of a sole in a profile.
struct SoleProfile {
  std::string name;                     ///< "left_foot", "right_foot".
  std::string frame;                    ///< Name of the link F.
  Pose X_FS;                            ///< Pose of the sole: z up, x forward.
  std::vector<Eigen::Vector2d> sole_S;  ///< Corners, m.
  int line;                             ///< Line in the file.
  /// Where the sole was found, if it was not measured.
  std::optional<SoleSource> source;
};

/// Reads a sole from a map with the keys that Profile describes. Throws Refusal
/// about an invalid value.
/// @param name  of the sole, for messages too.
SoleProfile ReadSole(const ProfileReader& reader, const std::string& name,
                     const YAML::Node& node);

}  // namespace poise
