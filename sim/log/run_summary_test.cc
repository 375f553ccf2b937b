// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/run_summary.h"

#include <gtest/gtest.h>

#include <fstream>

namespace poise {
namespace {

namespace fs = std::filesystem;

// Digest of "abc", the first example of FIPS 180-4.
constexpr char kHash[] =
    "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

class RunSummaryTest : public testing::Test {
 protected:
  RunSummaryTest() {
    fs::remove_all(run_);
    fs::create_directories(run_);
  }
  void Write(const std::string& name, const std::string& text) {
    std::ofstream(run_ / name, std::ios::binary) << text;
  }

  const fs::path run_ = fs::path(testing::TempDir()) / "run";
};

TEST_F(RunSummaryTest, ReadsTheSummaryThatBelongsToTheLog) {
  for (const char* log : {"log.bin", "log.csv"}) {
    Write(log, "abc");
    Write(
        "summary.json",
        std::string(R"({"recovered": true, "log_sha256": ")") + kHash + "\"}");
    const RunSummary summary = ReadRunSummary(run_);
    EXPECT_EQ(summary.values["recovered"], true);
    EXPECT_EQ(summary.note, "");
    EXPECT_FALSE(summary.is_of_other_log);
  }
  Write("summary.json", R"({"recovered": true})");
  EXPECT_EQ(ReadRunSummary(run_).values["recovered"], true);
}

TEST_F(RunSummaryTest, RejectsTheSummaryOfALogThatWasCutOrChanged) {
  Write("summary.json",
        std::string(R"({"recovered": true, "log_sha256": ")") + kHash + "\"}");
  for (const char* log : {"ab", "abd", ""}) {
    Write("log.csv", log);
    const RunSummary summary = ReadRunSummary(run_);
    EXPECT_TRUE(summary.values.is_null());
    EXPECT_TRUE(summary.is_of_other_log);
    EXPECT_EQ(summary.note,
              "summary.json does not belong to this log.csv: its log_sha256 "
              "differs. The log is of another run, or was cut short or "
              "changed.");
  }
}

TEST_F(RunSummaryTest, ReportsAMissingSummary) {
  Write("log.csv", "abc");
  RunSummary summary = ReadRunSummary(run_);
  EXPECT_TRUE(summary.values.is_null());
  EXPECT_FALSE(summary.is_of_other_log);
  EXPECT_EQ(summary.note, "summary.json does not exist.");
  Write("summary.json", "[1]");
  summary = ReadRunSummary(run_);
  EXPECT_TRUE(summary.values.is_null());
  EXPECT_EQ(summary.note, "summary.json cannot be read as JSON.");
}

}  // namespace
}  // namespace poise
