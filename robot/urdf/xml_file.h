// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <memory>
#include <string>
#include <string_view>

namespace poise {

/// Parses XML from anyone: at most 16 MiB of it beside comments, at most 100
/// elements deep, without a document type, so that no entity expands, and with
/// nothing after the root element. A file of 100 MB takes less than 1 GiB and a
/// few seconds.
///
/// @param source  what to call it in a message.
///
/// Throws Refusal: source, line, what was wanted.
std::unique_ptr<tinyxml2::XMLDocument> ParseXml(std::string_view text,
                                                const std::string& source);

}  // namespace poise
