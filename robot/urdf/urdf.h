// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "poise/math/inertia.h"
#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// A URDF that has been read and checked once. MakeModel() makes its models.
///
/// The root link is the floating base, even if it has no mass or is called
/// `world`. Exception: massless links from the root down to a joint of type
/// `floating` represent the world, and are left out. A mimic joint is an
/// ordinary joint of the tree; RobotModel::mimics gives its source. A link
/// without `<inertial>` has mass 0, and at least one link must have a positive
/// mass. Mesh files are not opened; their places are in RobotModel. The result
/// does not depend on the locale.
class UrdfDocument {
 public:
  /// Reads a file. The cost is O(n log n) in the length of the file, and less
  /// than 10 s and 1 GiB for any file.
  ///
  /// @param findings  if not null, receives each note and warning about the
  ///                  file. Also receives each reason to reject the file,
  ///                  before Refusal is thrown.
  /// @param packages  folders of packages, see FindMesh().
  ///
  /// Throws Refusal with one line that gives the file, the element, its value
  /// and the valid values.
  explicit UrdfDocument(const std::filesystem::path& file,
                        std::vector<Finding>* findings = nullptr,
                        std::vector<std::filesystem::path> packages = {});

  /// Reads the text of a URDF. Meshes of its models are not searched.
  ///
  /// @param source  the name of the text in messages.
  UrdfDocument(std::string_view text, std::string source,
               std::vector<Finding>* findings = nullptr);

  /// Returns the file, or the name of the text.
  const std::string& source() const { return source_; }

  /// Makes a model.
  ///
  /// @param locked  the joints to fix, with their values in rad or m. These
  ///                joints are not in the tree; the links below them remain as
  ///                frames.
  /// @param added   inertias to add to links, by the name of the link.
  RobotModel MakeModel(const std::map<std::string, double>& locked = {},
                       const std::map<std::string, Inertia>& added = {}) const;

 private:
  struct Content;

  std::string source_;
  std::shared_ptr<const Content> content_;
  MeshPlaces mesh_places_;
};

/// Reads a robot from a URDF file. Returns
/// UrdfDocument(file, findings).MakeModel(locked).
RobotModel LoadUrdf(const std::filesystem::path& file,
                    const std::map<std::string, double>& locked = {},
                    std::vector<Finding>* findings = nullptr);

/// Reads a robot from the text of a URDF, as LoadUrdf() does from a file.
///
/// @param source  the name of the text in messages.
RobotModel ParseUrdf(std::string_view text, const std::string& source,
                     const std::map<std::string, double>& locked = {},
                     std::vector<Finding>* findings = nullptr);

/// Returns the mass of each link, in kg. In contrast, RobotModel::tree has the
/// masses of bodies; a body merges all links that are fixed to each other.
/// @pre LoadUrdf() accepts the file.
std::map<std::string, double> LoadLinkMasses(const std::filesystem::path& file);

}  // namespace poise
