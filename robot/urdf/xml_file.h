// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <memory>
#include <string>
#include <string_view>

namespace poise {

/// Parses XML from an untrusted source. The text may have at most 16 MiB beside
/// comments, elements at most 100 deep, and nothing after the root element. It
/// may not declare a document type, so that no entity expands. A file of 100 MB
/// takes less than 1 GiB and a few seconds.
///
/// @param source  the name of the text in messages.
///
/// Throws Refusal with source, line and what was wanted.
std::unique_ptr<tinyxml2::XMLDocument> ParseXml(std::string_view text,
                                                const std::string& source);

}  // namespace poise
