// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <string>

#include "poise/robot/robot.h"

namespace poise {

/// The result of the search for a mesh file.
struct MeshPlace {
  std::filesystem::path path;  ///< Empty if the file was not found.
  std::string searched;        ///< The places that were searched, a text.
};

/// Searches a mesh file. The name of the file in the URDF is one of:
///  - `package://NAME/REST`, or `model://NAME/REST`: REST in the folder NAME.
///    The folder is searched beside and above the URDF, up to the root, then in
///    `places.packages`, then in the folders of the environment variable
///    ROS_PACKAGE_PATH, then in `share` of those of AMENT_PREFIX_PATH. One of
///    these folders may also be the package itself.
///  - a relative path: relative to the folder of the URDF.
///  - an absolute path, with or without `file://` in front.
///
/// Only an existing regular file is found.
MeshPlace FindMesh(const MeshPlaces& places, const std::string& file);

}  // namespace poise
