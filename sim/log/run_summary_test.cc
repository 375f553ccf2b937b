// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/run_summary.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>

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
    EXPECT_EQ(summary.note,
              "summary.json does not belong to this log.csv: its log_sha256 "
              "differs. The log is of another run, or was cut short or "
              "changed.");
  }
}

TEST_F(RunSummaryTest, ReportsAMissingSummary) {
  Write("log.csv", "abc");
  const RunSummary summary = ReadRunSummary(run_);
  EXPECT_TRUE(summary.values.is_null());
  EXPECT_EQ(summary.note, "summary.json does not exist.");
}

TEST_F(RunSummaryTest, RejectsABrokenSummary) {
  Write("log.csv", "abc");
  const std::pair<const char*, const char*> cases[] = {
      {"", ": is empty, must be JSON"},
      {R"({"recovered": tr)", ":1:16: is not JSON: the file ends too early"},
      {R"({"recovered": true, "recovered": false})",
       ": has the key \"recovered\" twice"},
      {"[]", ": is [], must be a JSON object"},
      {"{}", ": has no key 'recovered', is not the summary of a run"},
      {R"({"recovered": "maybe"})",
       ": recovered is \"maybe\", must be true, false or null"},
      {R"({"recovered": true, "control_dt": -1})",
       ": control_dt is -1, must be a positive time, s"},
      {R"({"recovered": true, "duration": -5})",
       ": duration is -5, must be a time of at least 0 s"},
      {R"({"recovered": true, "fell_at": "soon"})",
       ": fell_at is \"soon\", must be a time of at least 0 s"}};
  for (const auto& [text, defect] : cases) {
    Write("summary.json", text);
    try {
      ReadRunSummary(run_);
      ADD_FAILURE() << "accepts " << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), (run_ / "summary.json").string() + defect +
                                  "; run push again, or remove this file to "
                                  "read the log alone");
    }
  }
}

}  // namespace
}  // namespace poise
