// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <string_view>

namespace poise {

/// Returns whether an attribute's text has an expression ${...} or $(...) that
/// xacro should have replaced by its value.
bool HasXacroExpression(std::string_view text);

/// Returns whether an element has the prefix `xacro:`: xacro should have
/// replaced the element.
bool IsXacro(const tinyxml2::XMLElement& element);

/// Returns whether an element is one of xacro from before xacro had a prefix.
bool IsXacroWithoutPrefix(const tinyxml2::XMLElement& element);

/// Returns whether an element, or any element below it, is a link, a joint, a
/// limit, a transmission, a mimic or an inertia, or is a macro with one of these
/// words in its name. Without the element the robot would move differently.
bool HasEssentialPart(const tinyxml2::XMLElement& element);

}  // namespace poise
