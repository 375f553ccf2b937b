// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push/record_run.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "poise/sim/log/log_rows.h"
#include "poise/tests/util/load_humanoid.h"
#include "poise/tools/commands/report/report_page.h"

namespace poise {
namespace {

namespace fs = std::filesystem;

class RecordRunTest : public testing::Test {
 protected:
  RecordRunTest() {
    fs::create_directories(folder_);
    for (const char* name : kOld) std::ofstream(folder_ / name) << "old";
    experiment_.scenario.duration = 0.05;
  }
  std::string Read(const char* name) const {
    std::ifstream stream(folder_ / name);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  }

  static constexpr const char* kOld[] = {"log.csv", "summary.json",
                                         "robot.json", "report.html"};
  const fs::path folder_ = fs::path(testing::TempDir()) / "run";
  Experiment experiment_{LoadHumanoid(), {}};
};

// The old files are removed during the run. Otherwise, after a kill, the new
// log would be next to the summary of another run.
TEST_F(RecordRunTest, RemovesFilesOfAnEarlierRun) {
  bool was_asked = false;
  RecordRun(experiment_, folder_, [&](double) {
    was_asked = true;
    for (const char* name : {"summary.json", "robot.json", "report.html"}) {
      EXPECT_FALSE(fs::exists(folder_ / name)) << name;
    }
    return true;
  });
  EXPECT_TRUE(was_asked);
  EXPECT_FALSE(fs::exists(folder_ / "report.html"));
  EXPECT_EQ(Read("summary.json")[0], '{');
  EXPECT_EQ(Read("robot.json")[0], '{');
}

// A report from the returned data equals a report from the files.
TEST_F(RecordRunTest, ReturnsTheContentsOfTheFiles) {
  for (const LogFormat format : {LogFormat::kCsv, LogFormat::kBinary}) {
    const RunRecord record = RecordRun(experiment_, folder_, {}, format);
    EXPECT_EQ(ReadRun(record.files), ReadRun(folder_));
    EXPECT_EQ(nlohmann::json::parse(Read("robot.json")), record.files.robot);
    fs::remove(folder_ / "log.csv");
  }
}

TEST_F(RecordRunTest, KeepsEarlierRunIfScenarioIsRejected) {
  experiment_.scenario.pushes.emplace_back();
  experiment_.scenario.pushes[0].link = "nose";
  EXPECT_THROW(RecordRun(experiment_, folder_), std::invalid_argument);
  for (const char* name : kOld) EXPECT_EQ(Read(name), "old") << name;
}

TEST_F(RecordRunTest, KeepsEarlierRunIfAFileCannotBeWritten) {
  const fs::path report = folder_ / "report.html";
  fs::remove(report);
  fs::create_directories(report / "below");
  try {
    RecordRun(experiment_, folder_);
    ADD_FAILURE() << "the run must be refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(error.what(),
              report.string() + ": cannot be written: Is a directory");
  }
  fs::remove_all(report);
  for (const char* name : {"log.csv", "summary.json", "robot.json"}) {
    EXPECT_EQ(Read(name), "old") << name;
  }
}

}  // namespace
}  // namespace poise
