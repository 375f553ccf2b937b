// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/binary_log_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/sim/log/log_rows.h"
#include "poise/sim/log/open_log.h"

namespace poise {
namespace {

using Kind = LogColumn::Kind;

const std::vector<LogColumn> kColumns = {{"time[s]", Kind::kTime},
                                         {"com.x[m]", Kind::kNumber},
                                         {"push.fy[N]", Kind::kNumber},
                                         {"status", Kind::kText},
                                         {"active", Kind::kText}};
constexpr int kRows = 40;

double TimeOf(int row) { return row * 1e-3; }
double ComOf(int row) { return 0.1 + 1e-3 * std::sin(0.1 * row); }
double PushOf(int row) {
  if (row == 7) return std::numeric_limits<double>::quiet_NaN();
  return row < 10 ? 0 : -1e7 / row;
}
std::string ActiveOf(int row) {
  return row % 3 == 0 ? "" : "torque.knee.max=" + std::to_string(row / 2);
}

std::string Log(LogFormat format) {
  const auto rows = MakeLogRows(format, kColumns);
  std::string bytes = rows->Header();
  for (int i = 0; i < kRows; ++i) {
    rows->Number(TimeOf(i));
    rows->Number(ComOf(i));
    rows->Number(PushOf(i));
    rows->Text("ok");
    rows->Text(ActiveOf(i));
    rows->EndRow(&bytes);
  }
  return bytes;
}

std::filesystem::path Written(const std::string& bytes) {
  const auto file = std::filesystem::path(testing::TempDir()) / "table.log";
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

int CountNext(LogReader* log) {
  int rows = 0;
  while (log->Next()) ++rows;
  return rows;
}

TEST(OpenLog, GivesTheSameRowsFromBothFormats) {
  for (const LogFormat format : {LogFormat::kCsv, LogFormat::kBinary}) {
    const auto log = OpenLog(Written(Log(format)));
    ASSERT_EQ(log->columns().size(), kColumns.size());
    EXPECT_EQ(log->Find("push.fy"), 2);
    EXPECT_EQ(log->CountRows(), kRows);
    for (int i = 0; i < kRows; ++i) {
      SCOPED_TRACE(i);
      ASSERT_TRUE(log->Next());
      // CSV has nine digits; the binary log has the exact time.
      EXPECT_NEAR(log->Number(0), TimeOf(i), 1e-12);
      if (format == LogFormat::kBinary) {
        EXPECT_EQ(log->Number(0), TimeOf(i));
      }
      // Half a unit of the last place of a float.
      EXPECT_NEAR(log->Number(1), ComOf(i), 0.11 * 6e-8);
      if (i == 7) {
        EXPECT_TRUE(std::isnan(log->Number(2)));
      } else {
        EXPECT_NEAR(log->Number(2), PushOf(i), 6e-8 * std::abs(PushOf(i)));
      }
      EXPECT_EQ(log->cell(3), "ok");
      EXPECT_EQ(log->cell(4), ActiveOf(i));
      EXPECT_TRUE(std::isnan(log->Number(3)));
    }
    EXPECT_FALSE(log->Next());
    EXPECT_FALSE(log->cut_short());
  }
}

// A killed run can cut the log at any byte. The reader must read exactly the
// complete rows.
TEST(BinaryLogReader, ReadsAllCompleteRowsOfALogThatIsCutAnywhere) {
  const std::string whole = Log(LogFormat::kBinary);
  const std::size_t header =
      MakeLogRows(LogFormat::kBinary, kColumns)->Header().size();
  int before = 0;
  for (std::size_t length = 8; length < whole.size(); ++length) {
    SCOPED_TRACE(length);
    BinaryLogReader log(Written(whole.substr(0, length)));
    const int rows = CountNext(&log);
    const bool is_whole = length == header || rows == before + 1;
    EXPECT_EQ(log.cut_short(), !is_whole);
    EXPECT_EQ(rows, is_whole && length != header ? before + 1 : before);
    EXPECT_FALSE(log.Next());
    before = rows;
  }
  EXPECT_EQ(before, kRows - 1);
}

TEST(BinaryLogReader, NamesADamagedRow) {
  std::string damaged = Log(LogFormat::kBinary);
  const std::size_t header =
      MakeLogRows(LogFormat::kBinary, kColumns)->Header().size();
  // Behind the size of the first row is the length of its first cell.
  damaged[header + 4] = static_cast<char>(0xff);
  BinaryLogReader log(Written(damaged));
  try {
    log.Next();
    ADD_FAILURE() << "reads a damaged row";
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.substr(text.find(": ")), ": row 1: is damaged");
  }
}

TEST(BinaryLogReader, StopsAtDamage) {
  const std::string whole = Log(LogFormat::kBinary);
  for (std::size_t at = 8; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(0xff);
    try {
      BinaryLogReader log(Written(damaged));
      EXPECT_LE(CountNext(&log), kRows);
      EXPECT_LE(log.CountRows(), kRows);
    } catch (const std::invalid_argument&) {
    }
  }
}

std::string MessageOf(const std::string& bytes) {
  try {
    BinaryLogReader log(Written(bytes));
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    return text.substr(text.find(": ") + 2);
  }
  return "";
}

TEST(BinaryLogReader, RejectsInvalidLogs) {
  using namespace std::string_literals;
  EXPECT_EQ(MessageOf("POISELAG"), "is not a binary log of Poise");
  EXPECT_EQ(MessageOf("POISELOG\2\0\0\0"s),
            "has log format version 2, must be 1");
  EXPECT_EQ(MessageOf("POISELOG\1\0\0\0\1\0\0\0x\1\0a"s),
            "column 'a' has kind 'x', must be d, f or t; the file is damaged");
  EXPECT_EQ(
      MessageOf("POISELOG\1\0\0\0\0\0\0\1"s),
      "has 16777216 columns, must have at most 1048576; the file is damaged");
  EXPECT_THROW(BinaryLogReader("no/such/log.bin"), std::invalid_argument);
  BinaryLogReader cut(Written("POISELOG\1\0\0"s));
  EXPECT_TRUE(cut.cut_short());
  EXPECT_TRUE(cut.columns().empty());
  EXPECT_FALSE(cut.Next());
  EXPECT_EQ(cut.CountRows(), 0);
}

TEST(FindLog, FindsTheBinaryLogOnlyWithoutACsvLog) {
  const auto run = std::filesystem::path(testing::TempDir()) / "run";
  std::filesystem::create_directories(run);
  EXPECT_EQ(FindLog(run).filename(), "log.csv");
  std::ofstream(run / "log.bin") << "POISELOG";
  EXPECT_EQ(FindLog(run).filename(), "log.bin");
  std::ofstream(run / "log.csv") << "";
  EXPECT_EQ(FindLog(run).filename(), "log.csv");
}

}  // namespace
}  // namespace poise
