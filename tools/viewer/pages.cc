// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/viewer/pages.h"

namespace poise {

// Each included file is one raw string literal, see BUILD.
const std::string_view kReportPage =
#include "tools/viewer/report.inc"
    ;

const std::string_view kMapPage =
#include "tools/viewer/map.inc"
    ;

}  // namespace poise
