// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <Eigen/Core>
#include <string>
#include <unordered_map>
#include <vector>

#include "poise/math/eigen_alignment.h"
#include "poise/robot/finding.h"

namespace poise {

/// The links of a URDF by name, or its joints by name.
using Elements = std::unordered_map<std::string, const tinyxml2::XMLElement*>;

/// Returns the text of an attribute, or "" if the element does not have it.
std::string Text(const tinyxml2::XMLElement& element, const char* attribute);

/// Returns an attribute as a number, or `otherwise` if the element does not
/// have it.
/// @pre PruneUrdf() found the attribute to be a number.
double Number(const tinyxml2::XMLElement& element, const char* attribute,
              double otherwise);

/// Returns an attribute as three numbers, or zeros if the element does not have
/// it.
/// @pre PruneUrdf() found the attribute to be three numbers.
Eigen::Vector3d Vector(const tinyxml2::XMLElement& element,
                       const char* attribute);

/// Returns whether a `<joint>` is revolute, continuous or prismatic.
bool IsMoving(const tinyxml2::XMLElement& joint);

/// Collects findings about elements. Each finding names the link or the joint
/// to which the element belongs.
class Critic {
 public:
  explicit Critic(std::vector<Finding>* findings) : findings_(findings) {}

  void Add(Severity severity, const tinyxml2::XMLElement& element,
           std::string what, std::string why) const;

  void Reject(const tinyxml2::XMLElement& element, std::string what,
              std::string why) const {
    Add(Severity::kReject, element, std::move(what), std::move(why));
  }
  void Warn(const tinyxml2::XMLElement& element, std::string what,
            std::string why) const {
    Add(Severity::kWarn, element, std::move(what), std::move(why));
  }
  void Note(const tinyxml2::XMLElement& element, std::string what,
            std::string why) const {
    Add(Severity::kNote, element, std::move(what), std::move(why));
  }

 private:
  std::vector<Finding>* findings_;
};

}  // namespace poise
