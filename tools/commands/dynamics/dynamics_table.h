// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "poise/dynamics/tree.h"

namespace poise {

/// Returns the result of ComputeDynamics() as tables for people, with units and
/// six digits. The tables have a row for each degree of freedom. They show the
/// diagonal of M, and the columns of A_G and J. The columns of the tables are
/// aligned for names of any length.
std::string FormatDynamics(const Tree& tree, const nlohmann::json& document);

}  // namespace poise
