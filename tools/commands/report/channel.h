// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace poise {

/// One quantity over time in 16 bits a value, for a page that has to stay
/// small:
///     value = min + (max - min) u / 65534,   u = 65535 for no number.
/// The error is at most (max - min) / 131068: 0.8 um for a CoM that moved
/// 0.1 m.
///
/// As JSON: {name, unit, min, max, data}, data being the u's, little-endian, in
/// base64.
nlohmann::json EncodeChannel(std::string_view name, std::string_view unit,
                             const std::vector<float>& values);

/// 32-bit floats, little-endian, in base64: for time, which wants more digits.
std::string EncodeFloats(const std::vector<float>& values);

}  // namespace poise
