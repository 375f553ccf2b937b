// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "poise/dynamics/tree.h"

namespace poise {

/// What ComputeDynamics() returns, as tables to be read, with units: of M the
/// diagonal, of A_G and J the columns, a row for each degree of freedom. Six
/// digits; columns stand below one another whatever the names are.
std::string FormatDynamics(const Tree& tree, const nlohmann::json& document);

}  // namespace poise
