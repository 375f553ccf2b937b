// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/sole_profile.h"

#include <Eigen/Geometry>
#include <cmath>

#include "poise/math/rpy.h"
#include "poise/robot/feet/feet.h"
#include "poise/robot/finding.h"
#include "poise/robot/profile/yaml_file.h"

namespace poise {
namespace {

// Refuses a point with a coordinate above 1 m, because no sole is as large. The
// file is then likely in another unit.
void ExpectSmall(const ProfileReader& reader, const Eigen::Vector2d& point,
                 const YAML::Node& at, const std::string& thing) {
  if (point.cwiseAbs().maxCoeff() <= 1) return;
  reader.Refuse(
      at, thing + " reaches over 1 m from the center, must be at most 1 m");
}

// Returns the sole's axes in the link. The z axis is along the normal. The x
// axis is near the link's x axis. If the normal is within 26 degrees of the
// link's x axis, the x axis is near the link's z axis instead.
Eigen::Matrix3d FromNormal(const ProfileReader& reader, const YAML::Node& node,
                           const std::string& thing) {
  const Eigen::Vector3d normal = reader.Numbers<3>(node, thing);
  if (!(normal.norm() > 1e-6))
    reader.Refuse(node, thing + " is zero, must be a direction");
  const Eigen::Vector3d z = normal.normalized();
  constexpr double kAlong = 0.9;
  const Eigen::Vector3d forward = std::abs(z.x()) < kAlong
                                      ? Eigen::Vector3d::UnitX()
                                      : Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d R;
  R.col(2) = z;
  R.col(1) = z.cross(forward).normalized();
  R.col(0) = R.col(1).cross(z);
  return R;
}

SoleSource ReadSource(const ProfileReader& reader, const YAML::Node& node,
                      const std::string& thing) {
  for (const SoleSource source :
       {SoleSource::kBox, SoleSource::kMesh, SoleSource::kGuess}) {
    if (node.IsScalar() && node.Scalar() == NameOf(source)) return source;
  }
  reader.Refuse(node, thing + ".from", "box, mesh or guess");
}

}  // namespace

SoleProfile ReadSole(const ProfileReader& reader, const std::string& name,
                     const YAML::Node& node) {
  const std::string thing = "feet." + name;
  reader.ExpectMap(
      node, thing,
      {"frame", "from", "normal", "polygon", "rpy", "size", "xyz"});
  SoleProfile sole{name, "", {}, {}, node.Mark().line + 1, std::nullopt};
  if (!node["frame"])
    reader.Refuse(node, thing + ": has no frame, must have the name of a link");
  sole.frame = reader.Text(node["frame"], thing + ".frame");
  if (node["from"]) sole.source = ReadSource(reader, node["from"], thing);
  if (node["xyz"]) sole.X_FS.p = reader.Numbers<3>(node["xyz"], thing + ".xyz");
  if (node["rpy"]) {
    sole.X_FS.R = MatrixFromRpy(reader.Angles(node["rpy"], thing + ".rpy"));
  }
  if (const YAML::Node normal = node["normal"]) {
    if (node["rpy"])
      reader.Refuse(node,
                    thing + ": has rpy and normal, must have one of them");
    sole.X_FS.R = FromNormal(reader, normal, thing + ".normal");
  }
  if (node["size"].IsDefined() == node["polygon"].IsDefined()) {
    reader.Refuse(node, thing + ": must have one of size and polygon");
  }
  if (const YAML::Node size = node["size"]) {
    const Eigen::Vector2d half = 0.5 * reader.Numbers<2>(size, thing + ".size");
    ExpectSmall(reader, half, size, thing + ".size");
    if (!(half.minCoeff() > 0)) {
      reader.Refuse(size, thing + ".size is [" + PrintNumber(2 * half.x()) +
                              ", " + PrintNumber(2 * half.y()) +
                              "], must be positive");
    }
    for (const double x : {-1, 1}) {
      for (const double y : {-1, 1}) {
        sole.sole_S.emplace_back(x * half.x(), y * half.y());
      }
    }
  } else {
    if (!node["polygon"].IsSequence()) {
      reader.Refuse(node["polygon"], thing + ".polygon", "a list of corners");
    }
    for (const YAML::Node& corner : node["polygon"]) {
      sole.sole_S.push_back(reader.Numbers<2>(corner, thing + ".polygon"));
      ExpectSmall(reader, sole.sole_S.back(), corner, thing + ".polygon");
    }
    if (!IsConvex(sole.sole_S)) {
      reader.Refuse(node["polygon"],
                    thing +
                        ".polygon is not convex, must be convex "
                        "with its corners in order");
    }
  }
  return sole;
}

}  // namespace poise
