// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/channel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace poise {
namespace {

// Decodes base64 by its definition, independent of the encoder.
std::vector<std::uint8_t> Decode(const std::string& base64) {
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : base64) {
    int digit = 0;
    if (c >= 'A' && c <= 'Z') {
      digit = c - 'A';
    } else if (c >= 'a' && c <= 'z') {
      digit = c - 'a' + 26;
    } else if (c >= '0' && c <= '9') {
      digit = c - '0' + 52;
    } else if (c == '+') {
      digit = 62;
    } else if (c == '/') {
      digit = 63;
    } else {
      break;
    }
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes.push_back(static_cast<std::uint8_t>(bits >> count & 255));
    }
  }
  return bytes;
}

std::vector<double> Values(const nlohmann::json& channel) {
  const std::vector<std::uint8_t> bytes = Decode(channel["data"]);
  const double min = channel["min"], max = channel["max"];
  std::vector<double> values;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    const int u = bytes[i] + 256 * bytes[i + 1];
    values.push_back(u == 65535 ? std::nan("") : min + (max - min) * u / 65534);
  }
  return values;
}

TEST(Channel, KeepsValuesWithinTheStatedError) {
  const std::vector<float> values = {-0.02f, 0.0f, 0.013f, 0.08f, 0.0799f};
  const nlohmann::json channel = EncodeChannel("com.x", "m", values);
  const std::vector<double> decoded = Values(channel);
  ASSERT_EQ(decoded.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(decoded[i], values[i], 0.1 / 131068);
  }
  // The ends of the range are exact.
  EXPECT_EQ(decoded[0], static_cast<double>(values[0]));
  EXPECT_EQ(decoded[3], static_cast<double>(values[3]));
  EXPECT_EQ(channel["name"], "com.x");
  EXPECT_EQ(channel["unit"], "m");
}

TEST(Channel, KeepsAConstantExactly) {
  for (const double value : Values(EncodeChannel("q", "", {0.7f, 0.7f}))) {
    EXPECT_EQ(value, static_cast<double>(0.7f));
  }
}

TEST(Channel, MarksNonFiniteValuesAndExcludesThemFromTheRange) {
  const float inf = std::numeric_limits<float>::infinity();
  const nlohmann::json channel =
      EncodeChannel("q", "", {std::nanf(""), 1, inf, 3, -inf});
  const std::vector<double> decoded = Values(channel);
  EXPECT_TRUE(std::isnan(decoded[0]));
  EXPECT_EQ(decoded[1], 1);
  EXPECT_TRUE(std::isnan(decoded[2]));
  EXPECT_EQ(decoded[3], 3);
  EXPECT_TRUE(std::isnan(decoded[4]));
}

TEST(Channel, EncodesEmptyAndAllNaNChannels) {
  EXPECT_EQ(EncodeChannel("q", "", {})["data"], "");
  EXPECT_TRUE(std::isnan(Values(EncodeChannel("q", "", {std::nanf("")}))[0]));
}

TEST(Channel, PadsBase64) {
  EXPECT_EQ(EncodeFloats({}), "");
  // 1.0f is 0x3f800000: 00 00 80 3f.
  EXPECT_EQ(EncodeFloats({1.0f}), "AACAPw==");
  EXPECT_EQ(EncodeFloats({1.0f, 1.0f}), "AACAPwAAgD8=");
  EXPECT_EQ(EncodeFloats({1.0f, 1.0f, 1.0f}), "AACAPwAAgD8AAIA/");
}

TEST(Channel, KeepsFloatsExactly) {
  const std::vector<float> values = {0.001f, 599.999f, -3e-30f};
  const std::vector<std::uint8_t> bytes = Decode(EncodeFloats(values));
  ASSERT_EQ(bytes.size(), 4 * values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    float value;
    std::memcpy(&value, &bytes[4 * i], sizeof value);
    EXPECT_EQ(value, values[i]);
  }
}

}  // namespace
}  // namespace poise
