// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace poise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(ParseNumbers, ReadsNumbersSeparatedByWhiteSpace) {
  const auto numbers = ParseNumbers(" 1\t-2.5e1\r\n+.5 ");
  ASSERT_TRUE(numbers.has_value());
  EXPECT_EQ(*numbers, (std::vector<double>{1, -25, 0.5}));
  EXPECT_TRUE(ParseNumbers("").value().empty());
}

TEST(ParseNumbers, RejectsAnythingElse) {
  for (const char* text :
       {"a", "1a", "0x10", "1,5", "+-1", "--1", "1e", "e5", ".", "1 2 x",
        "\xc2\xa0"
        "1"}) {
    EXPECT_FALSE(ParseNumbers(text).has_value()) << text;
  }
}

TEST(ParseNumbers, ReadsInfinityAndNan) {
  EXPECT_EQ(ParseNumbers("inf").value()[0], kInfinity);
  EXPECT_EQ(ParseNumbers("-inf").value()[0], -kInfinity);
  EXPECT_TRUE(std::isnan(ParseNumbers("nan").value()[0]));
}

TEST(ParseNumbers, OverflowsToInfinityAndUnderflowsToZero) {
  const std::string zeros(400, '0');
  for (const std::string& large :
       std::vector<std::string>{std::string("1e400"), "1" + zeros,
                                "1" + zeros + "e-1", "1e+400", "0.01e999",
                                "00"
                                "1" +
                                    zeros + ".5",
                                "1e99999999999999999999999"}) {
    EXPECT_EQ(ParseNumbers(large).value()[0], kInfinity) << large;
    EXPECT_EQ(ParseNumbers("-" + large).value()[0], -kInfinity) << large;
  }
  for (const std::string& small : std::vector<std::string>{
           std::string("1e-400"), "0." + zeros + "1", "0." + zeros + "1e5",
           "00." + zeros + "1", "." + zeros + "1", "100e-900",
           "1e-99999999999999999999999"}) {
    EXPECT_EQ(ParseNumbers(small).value()[0], 0) << small;
  }
}

}  // namespace
}  // namespace poise
