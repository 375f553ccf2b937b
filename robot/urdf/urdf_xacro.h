// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <string_view>

namespace poise {

/// Returns whether an attribute's text contains an expression ${...} or $(...),
/// which xacro should have replaced by a value.
bool HasXacroExpression(std::string_view text);

/// Returns whether an element has the prefix `xacro:`. xacro should have
/// replaced such an element.
bool IsXacro(const tinyxml2::XMLElement& element);

/// Returns whether an element belongs to an old xacro version without a prefix.
bool IsXacroWithoutPrefix(const tinyxml2::XMLElement& element);

/// Returns whether the robot would move differently without an element. Such
/// elements are links, joints, limits, masses, transmissions, mimics, inertias,
/// and macros with one of these words in the name. The elements below are also
/// checked.
bool HasEssentialPart(const tinyxml2::XMLElement& element);

}  // namespace poise
