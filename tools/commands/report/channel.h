// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace poise {

/// Encodes a quantity over time with 16 bits per value, to keep pages small:
///     value = min + (max - min) u / 65534,   u = 65535 if not finite.
/// The error is at most (max - min) / 131068, for example 0.8 um for a CoM that
/// moved by 0.1 m.
///
/// Returns JSON: {name, unit, min, max, data}. data has all u, little-endian,
/// in base64.
nlohmann::json EncodeChannel(std::string_view name, std::string_view unit,
                             const std::vector<float>& values);

/// Encodes 32-bit floats, little-endian, in base64. It is used for time, which
/// needs more digits than EncodeChannel() keeps.
std::string EncodeFloats(const std::vector<float>& values);

}  // namespace poise
