// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <memory>
#include <string>
#include <string_view>

namespace poise {

/// Parses XML from an untrusted source. Without comments, the text may have at
/// most 16 MiB. Elements may be nested at most 100 levels deep. The text must
/// not declare a document type, so that no entity can expand. A file of 100 MB
/// takes less than 1 GiB and a few seconds.
///
/// @param source  the name of the text in messages.
///
/// Throws Refusal with the source, the line and the broken rule.
std::unique_ptr<tinyxml2::XMLDocument> ParseXml(std::string_view text,
                                                const std::string& source);

}  // namespace poise
