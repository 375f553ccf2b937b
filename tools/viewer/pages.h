// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string_view>

namespace poise {

/// The built pages of dist/. They are inside the program that fills them, so
/// that it needs no data file when it runs.
extern const std::string_view kReportPage;
extern const std::string_view kMapPage;

}  // namespace poise
