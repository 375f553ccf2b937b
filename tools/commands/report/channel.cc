// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/channel.h"

#include <openssl/evp.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

namespace poise {
namespace {

constexpr std::uint16_t kNoNumber = 65535;
constexpr double kSteps = 65534;

std::string Base64(const std::vector<std::uint8_t>& bytes) {
  // EVP_EncodeBlock() returns the length of the text as an int.
  if (bytes.size() > std::numeric_limits<int>::max() / 4 * 3) {
    throw std::length_error("base64: a channel has " +
                            std::to_string(bytes.size()) +
                            " bytes, must have at most 1.6e9");
  }
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');
  text.resize(EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                              bytes.data(), static_cast<int>(bytes.size())));
  return text;
}

}  // namespace

nlohmann::json EncodeChannel(std::string_view name, std::string_view unit,
                             const std::vector<float>& values) {
  double min = std::numeric_limits<double>::infinity();
  double max = -min;
  for (const float value : values) {
    if (!std::isfinite(value)) continue;
    min = std::min<double>(min, value);
    max = std::max<double>(max, value);
  }
  if (min > max) min = max = 0;
  const double scale = max > min ? kSteps / (max - min) : 0;

  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * values.size());
  for (const float value : values) {
    const std::uint16_t u =
        std::isfinite(value)
            ? static_cast<std::uint16_t>(std::lround((value - min) * scale))
            : kNoNumber;
    bytes.push_back(static_cast<std::uint8_t>(u & 255));
    bytes.push_back(static_cast<std::uint8_t>(u >> 8));
  }
  return {{"name", name},
          {"unit", unit},
          {"min", min},
          {"max", max},
          {"data", Base64(bytes)}};
}

std::string EncodeFloats(const std::vector<float>& values) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * values.size());
  for (const float value : values) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    for (int shift = 0; shift < 32; shift += 8) {
      bytes.push_back(static_cast<std::uint8_t>(bits >> shift & 255));
    }
  }
  return Base64(bytes);
}

}  // namespace poise
