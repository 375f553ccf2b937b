// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/finding.h"

namespace poise {

/// An attribute that Poise reads.
struct AttributeRule {
  const char* name;
  int numbers;  ///< The count of numbers in it; 0 for a text.
  bool required = true;
};

/// An element that Poise reads, with its attributes and children.
struct ElementRule {
  const char* name;
  std::vector<AttributeRule> attributes;
  std::vector<const ElementRule*> children;
  bool required = false;
  bool repeated = false;
  /// The severity if an attribute or a child is missing or invalid. kReject
  /// rejects the file. kWarn and kNote remove the element.
  Severity fault = Severity::kReject;
};

/// The elements and attributes of a URDF that Poise reads. kRobot is the whole
/// grammar.
namespace urdf_rules {

inline constexpr bool kOptional = false;

inline const ElementRule kOrigin{
    "origin", {{"xyz", 3, kOptional}, {"rpy", 3, kOptional}}, {}};
inline const ElementRule kMass{"mass", {{"value", 1}}, {}, true};
inline const ElementRule kInertia{
    "inertia",
    {{"ixx", 1}, {"ixy", 1}, {"ixz", 1}, {"iyy", 1}, {"iyz", 1}, {"izz", 1}},
    {},
    true};
inline const ElementRule kInertial{
    "inertial", {}, {&kOrigin, &kMass, &kInertia}};
inline const ElementRule kBox{"box", {{"size", 3}}, {}};
inline const ElementRule kSphere{"sphere", {{"radius", 1}}, {}};
inline const ElementRule kCylinder{
    "cylinder", {{"radius", 1}, {"length", 1}}, {}};
inline const ElementRule kMesh{
    "mesh", {{"filename", 0}, {"scale", 3, kOptional}},
    {},     false,
    false,  Severity::kWarn};
inline const ElementRule kGeometry{
    "geometry", {},    {&kBox, &kSphere, &kCylinder, &kMesh},
    true,       false, Severity::kWarn};
inline const ElementRule kColor{"color", {{"rgba", 4}}, {},
                                false,   false,         Severity::kWarn};
inline const ElementRule kTexture{"texture", {{"filename", 0}}, {}, false,
                                  false,     Severity::kNote};
inline const ElementRule kMaterial{
    "material", {{"name", 0}}, {&kColor, &kTexture},
    false,      false,         Severity::kWarn};
inline const ElementRule kVisual{
    "visual", {},   {&kOrigin, &kGeometry, &kMaterial},
    false,    true, Severity::kWarn};
inline const ElementRule kCollision{"collision", {},   {&kOrigin, &kGeometry},
                                    false,       true, Severity::kWarn};
inline const ElementRule kLink{
    "link", {{"name", 0}}, {&kInertial, &kVisual, &kCollision}, false, true};
inline const ElementRule kParent{"parent", {{"link", 0}}, {}, true};
inline const ElementRule kChild{"child", {{"link", 0}}, {}, true};
inline const ElementRule kAxis{"axis", {{"xyz", 3}}, {}};
inline const ElementRule kLimit{"limit",
                                {{"lower", 1, kOptional},
                                 {"upper", 1, kOptional},
                                 {"effort", 1},
                                 {"velocity", 1}},
                                {}};
inline const ElementRule kDynamics{
    "dynamics", {{"damping", 1, kOptional}, {"friction", 1, kOptional}}, {}};
inline const ElementRule kMimic{
    "mimic",
    {{"joint", 0}, {"multiplier", 1, kOptional}, {"offset", 1, kOptional}},
    {}};
inline const ElementRule kJoint{
    "joint",
    {{"name", 0}, {"type", 0}},
    {&kOrigin, &kParent, &kChild, &kAxis, &kLimit, &kDynamics, &kMimic},
    false,
    true};
inline const ElementRule kMaterialAtTop{
    "material", {{"name", 0}}, {&kColor, &kTexture},
    false,      true,          Severity::kWarn};
inline const ElementRule kRobot{
    "robot", {{"name", 0}}, {&kMaterialAtTop, &kLink, &kJoint}};

}  // namespace urdf_rules
}  // namespace poise
