// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/urdf/urdf_xacro.h"

#include <algorithm>
#include <string>

namespace poise {
namespace {

using tinyxml2::XMLElement;

// URDF elements that are essential for the robot's motion, by their full names.
constexpr std::string_view kElements[] = {"inertia", "inertial",    "joint",
                                          "limit",   "link",        "mass",
                                          "mimic",   "transmission"};

// Elements of old xacro versions, which had no prefix `xacro:`.
constexpr std::string_view kWithoutPrefix[] = {"include", "insert_block",
                                               "macro", "property"};

// Words that mark a macro as essential if its name contains one of them.
constexpr std::string_view kWords[] = {"inerti", "joint", "limit",       "link",
                                       "mass",   "mimic", "transmission"};

bool Contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

char Lower(char c) { return 'A' <= c && c <= 'Z' ? c - 'A' + 'a' : c; }

bool IsEssential(const XMLElement& element) {
  const std::string_view name = element.Name();
  if (!IsXacro(element)) {
    return std::find(std::begin(kElements), std::end(kElements), name) !=
           std::end(kElements);
  }
  std::string lower(name);
  std::transform(name.begin(), name.end(), lower.begin(), Lower);
  return std::any_of(
      std::begin(kWords), std::end(kWords),
      [&](std::string_view word) { return Contains(lower, word); });
}

}  // namespace

bool HasXacroExpression(std::string_view text) {
  return Contains(text, "${") || Contains(text, "$(");
}

bool IsXacro(const XMLElement& element) {
  constexpr std::string_view kPrefix = "xacro:";
  return std::string_view(element.Name()).substr(0, kPrefix.size()) == kPrefix;
}

bool IsXacroWithoutPrefix(const XMLElement& element) {
  return std::find(std::begin(kWithoutPrefix), std::end(kWithoutPrefix),
                   element.Name()) != std::end(kWithoutPrefix);
}

// ParseXml() bounds the depth of the recursion.
bool HasEssentialPart(const XMLElement& element) {
  if (IsEssential(element)) return true;
  for (const XMLElement* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (HasEssentialPart(*child)) return true;
  }
  return false;
}

}  // namespace poise
