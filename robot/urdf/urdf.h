// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/robot.h"

namespace poise {

/// A URDF that has been read and checked once, from which models are made.
///
/// The root link is the floating base, even if it has no mass or is called
/// `world`. Massless links from the root down to a joint of type `floating`
/// stand for the world and are left out. A mimic joint is a joint of the tree
/// like any other; RobotModel::mimics gives its source. A link without
/// `<inertial>` has no mass, and at least one link must have mass. Meshes are
/// named, never opened. Numbers are read the same in every locale.
class UrdfDocument {
 public:
  /// Reads a file. Any file takes less than 10 s and 1 GiB; the cost is
  /// O(n log n) in its length.
  ///
  /// @param findings  if not null, receives each note and warning about the file,
  ///                  and each reason to reject it before Refusal is thrown.
  ///
  /// Throws Refusal with one line that names the file, the element, its value and
  /// what was wanted.
  explicit UrdfDocument(const std::filesystem::path& file,
                        std::vector<Finding>* findings = nullptr);

  /// Reads the text of a URDF.
  ///
  /// @param source  the name of the text in messages.
  UrdfDocument(std::string_view text, std::string source,
               std::vector<Finding>* findings = nullptr);

  /// Returns the file, or the name of the text.
  const std::string& source() const { return source_; }

  /// Makes a model.
  ///
  /// @param locked  joints to fix, by name, at a value in rad or m. The tree has
  ///                no such joint; the links below it remain as frames.
  RobotModel MakeModel(const std::map<std::string, double>& locked = {}) const;

 private:
  struct Content;

  std::string source_;
  std::shared_ptr<const Content> content_;
};

/// Reads a robot from a URDF file: UrdfDocument(file, findings).MakeModel(locked).
RobotModel LoadUrdf(const std::filesystem::path& file,
                    const std::map<std::string, double>& locked = {},
                    std::vector<Finding>* findings = nullptr);

/// Reads a robot from the text of a URDF, as LoadUrdf() does from a file.
///
/// @param source  the name of the text in messages.
RobotModel ParseUrdf(std::string_view text, const std::string& source,
                     const std::map<std::string, double>& locked = {},
                     std::vector<Finding>* findings = nullptr);

/// Returns the mass of each link, in kg. RobotModel::tree has the masses of
/// bodies, which join all links that are fixed to each other.
/// @pre LoadUrdf() reads the file.
std::map<std::string, double> LoadLinkMasses(const std::filesystem::path& file);

}  // namespace poise
