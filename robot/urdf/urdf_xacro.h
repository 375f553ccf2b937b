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

/// Returns whether the robot would move differently without an element. This is
/// so if the element, or any element below it, is a link, a joint, a limit, a
/// mass, a transmission, a mimic or an inertia. It is also so for a macro with
/// one of these words in its name.
bool HasEssentialPart(const tinyxml2::XMLElement& element);

}  // namespace poise
