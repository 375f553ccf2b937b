// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <Eigen/Core>
#include <string>
#include <unordered_map>
#include <vector>

#include "robot/finding.h"

namespace poise {

/// The links or the joints of a URDF, by name.
using Elements = std::unordered_map<std::string, const tinyxml2::XMLElement*>;

/// An attribute, empty where it is not there.
std::string Text(const tinyxml2::XMLElement& element, const char* attribute);

/// An attribute that is known to be a number where it is there.
double Number(const tinyxml2::XMLElement& element, const char* attribute,
              double otherwise);

/// An attribute that is known to be three numbers; zero where it is not there.
Eigen::Vector3d Vector(const tinyxml2::XMLElement& element,
                       const char* attribute);

/// Whether a `<joint>` is revolute, continuous or prismatic.
bool IsMoving(const tinyxml2::XMLElement& joint);

/// Collects what is found about elements, each named by the link or joint it
/// is in.
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
