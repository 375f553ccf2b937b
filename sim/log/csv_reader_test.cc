// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/csv_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace poise {
namespace {

std::filesystem::path Written(const std::string& text) {
  const auto file = std::filesystem::path(testing::TempDir()) / "table.csv";
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

TEST(CsvReader, ReadsRowByRow) {
  CsvReader csv(Written("time[s],base.z[m],status\n0,0.79,ok\n1e-3,-2,\n"));
  EXPECT_EQ(csv.columns().size(), 3u);
  ASSERT_TRUE(csv.Next());
  EXPECT_EQ(csv.Number(0), 0);
  EXPECT_EQ(csv.Number(1), 0.79);
  EXPECT_EQ(csv.cell(2), "ok");
  ASSERT_TRUE(csv.Next());
  EXPECT_EQ(csv.Number(0), 1e-3);
  EXPECT_EQ(csv.Number(1), -2);
  EXPECT_EQ(csv.cell(2), "");
  EXPECT_FALSE(csv.Next());
  EXPECT_FALSE(csv.cut_short());
}

TEST(CsvReader, FindsAColumnWithOrWithoutItsUnit) {
  CsvReader csv(Written("time[s],com.x[m],active\n"));
  EXPECT_EQ(csv.Find("com.x"), 1);
  EXPECT_EQ(csv.Find("com.x[m]"), 1);
  EXPECT_EQ(csv.Find("active"), 2);
  EXPECT_EQ(csv.Find("com"), std::nullopt);
  EXPECT_EQ(UnitOf("com.x[m]"), "m");
  EXPECT_EQ(UnitOf("active"), "");
  EXPECT_EQ(UnitOf("a]b["), "");
  EXPECT_EQ(WithoutUnit("com.x[m]"), "com.x");
}

TEST(CsvReader, StopsWhereTheLogWasCutShort) {
  for (const char* tail : {"2,3", "2", "2,"}) {
    SCOPED_TRACE(tail);
    CsvReader csv(Written(std::string("a,b\n0,1\n") + tail));
    EXPECT_TRUE(csv.Next());
    EXPECT_FALSE(csv.Next());
    EXPECT_TRUE(csv.cut_short());
    EXPECT_FALSE(csv.Next());
  }
}

// The short row has a line end, so it is an error and not a log cut short.
TEST(CsvReader, RejectsARowWithAnotherNumberOfCells) {
  const auto file = Written("a,b\n0,1\n2\n4,5\n");
  CsvReader csv(file);
  EXPECT_TRUE(csv.Next());
  try {
    csv.Next();
    ADD_FAILURE() << "a row with too few cells was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(error.what(),
              file.string() + ":3: has 1 cells, must have 2 as in the header");
  }
}

TEST(CsvReader, ReadsAnEmptyCellAsNaN) {
  CsvReader csv(Written("a,b,status\nnan,,7\n"));
  ASSERT_TRUE(csv.Next());
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(std::isnan(csv.Number(i))) << i;
}

TEST(CsvReader, RejectsTextInANumberColumn) {
  const auto refusal = [](const std::string& row) -> std::string {
    const auto file = Written("time[s],base.qx,lost\n0,-inf,ok\n" + row + "\n");
    CsvReader csv(file);
    EXPECT_TRUE(csv.Next());
    try {
      csv.Next();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).substr(file.string().size());
    }
    return "accepted";
  };
  EXPECT_EQ(refusal("1,2,x"), "accepted");
  EXPECT_EQ(refusal("1,0.5x1,x"),
            ":3: column 'base.qx' is '0.5x1', must be a number");
  EXPECT_EQ(refusal("1 ,2,"), ":3: column 'time[s]' is '1 ', must be a number");
}

TEST(CsvReader, ReadsWindowsLineEnds) {
  CsvReader csv(Written("a,b\r\n1,2\r\n"));
  ASSERT_TRUE(csv.Next());
  EXPECT_EQ(csv.Find("b"), 1);
  EXPECT_EQ(csv.Number(1), 2);
}

TEST(CsvReader, ReadsAnEmptyFileAsNoColumnsAndNoRows) {
  CsvReader csv(Written(""));
  EXPECT_TRUE(csv.columns().empty());
  EXPECT_FALSE(csv.Next());
}

TEST(CsvReader, NamesAMissingFile) {
  try {
    CsvReader csv("no/such/log.csv");
    FAIL() << "opened a file that does not exist";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "no/such/log.csv: cannot be opened");
  }
  EXPECT_THROW(CsvReader(std::filesystem::path(testing::TempDir())),
               std::invalid_argument);
}

TEST(CsvReader, HasNoColumnsIfTheHeaderIsCut) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "cut.csv";
  std::ofstream(file) << "time[s],sta";
  CsvReader log(file);
  EXPECT_TRUE(log.columns().empty());
  EXPECT_TRUE(log.cut_short());
  EXPECT_FALSE(log.Next());
}

}  // namespace
}  // namespace poise
