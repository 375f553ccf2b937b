// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/log_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace poise {
namespace {

using Kind = LogColumn::Kind;
using namespace std::string_literals;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const std::vector<LogColumn> kColumns = {
    {"t", Kind::kTime}, {"x[m]", Kind::kNumber}, {"status", Kind::kText}};

std::string TwoRows(LogFormat format, double second_x) {
  const auto rows = MakeLogRows(format, kColumns);
  std::string bytes = rows->Header();
  rows->Number(0);
  rows->Number(1);
  rows->Text("ok");
  rows->EndRow(&bytes);
  rows->Number(0.25);
  rows->Number(second_x);
  rows->Text("ok");
  rows->EndRow(&bytes);
  return bytes;
}

// docs/log.md specifies this format.
TEST(LogRows, AreLinesOfCommaSeparatedValues) {
  EXPECT_EQ(LogFileName(LogFormat::kCsv), "log.csv");
  EXPECT_EQ(TwoRows(LogFormat::kCsv, 0.123456789123),
            "t,x[m],status\n0,1,ok\n0.25,0.123456789,ok\n");
  EXPECT_EQ(TwoRows(LogFormat::kCsv, -1.5e-9),
            "t,x[m],status\n0,1,ok\n0.25,-1.5e-09,ok\n");
  for (const double nan : {kNan, -kNan}) {
    EXPECT_EQ(TwoRows(LogFormat::kCsv, nan),
              "t,x[m],status\n0,1,ok\n0.25,nan,ok\n");
  }
}

TEST(LogRows, ReplaceCommasAndLineEndsInNames) {
  const auto rows = MakeLogRows(LogFormat::kCsv, {{"a,b\n", Kind::kText}});
  std::string bytes = rows->Header();
  rows->Text("1,2\r\n");
  rows->EndRow(&bytes);
  EXPECT_EQ(bytes, "a_b_\n1_2__\n");
}

// docs/log.md specifies this format, byte by byte.
TEST(LogRows, AreDifferencesToTheLastRowInBinary) {
  EXPECT_EQ(LogFileName(LogFormat::kBinary), "log.bin");
  const std::string header =
      "POISELOG\1\0\0\0\3\0\0\0"
      "d\1\0t"
      "f\4\0x[m]"
      "t\6\0status"s;
  // 1 is 0x3f800000 as a float, 0.25 is 0x3fd0000000000000 as a double. A row
  // consists of its size, the lengths of its cells and the data. The lengths
  // here are 0, 4 and 1 for new text.
  const std::string first =
      "\x0c\0\0\0"
      "\x40\1"
      "\0\0\x80\x3f"
      "\2\0\0\0ok"s;
  const auto second = [](const std::string& lengths, const std::string& x) {
    return std::string(1, static_cast<char>(10 + x.size())) + "\0\0\0"s +
           lengths + "\0\0\0\0\0\0\xd0\x3f"s + x;
  };
  EXPECT_EQ(TwoRows(LogFormat::kBinary, 1),
            header + first + second("\x08\0"s, ""));
  // -1 differs from 1 in the first bit: four bytes. 1 + 2^-23 differs in the
  // last bit: one byte.
  EXPECT_EQ(TwoRows(LogFormat::kBinary, -1),
            header + first + second("\x48\0"s, "\0\0\0\x80"s));
  EXPECT_EQ(TwoRows(LogFormat::kBinary, 1 + std::ldexp(1, -23)),
            header + first + second("\x18\0"s, "\1"));
  // Every NaN has the same bytes.
  EXPECT_EQ(TwoRows(LogFormat::kBinary, kNan),
            TwoRows(LogFormat::kBinary, -kNan));
}

}  // namespace
}  // namespace poise
