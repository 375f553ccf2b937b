// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/run_log.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "poise/tools/commands/report/channel.h"

namespace poise {
namespace {

using nlohmann::json;

constexpr char kHeader[] =
    "time[s],base.z[m],base.qx,com.x[m],com_ref.x[m],left_foot.fz[N],"
    "tau.knee[Nm],q.knee[rad],status,active\n";

std::filesystem::path Written(const std::string& text) {
  const auto file = std::filesystem::path(testing::TempDir()) / "log.csv";
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

json Names(const json& table) {
  json names = json::array();
  for (const json& channel : table["channels"])
    names.push_back(channel["name"]);
  return names;
}

TEST(RunLog, SortsColumnsIntoTheTablesThatNeedThem) {
  const json log = ReadRunLog(
      Written(std::string(kHeader) + "0,0.8,0,0.01,0.02,190,3,0.7,ok,\n"));
  EXPECT_EQ(log["rows"], 1);
  EXPECT_EQ(Names(log["motion"]),
            json({"base.z", "base.qx", "com.x", "left_foot.fz", "q.knee"}));
  EXPECT_EQ(Names(log["signals"]), json({"base.z", "com.x", "com_ref.x",
                                         "left_foot.fz", "com_error.x"}));
  EXPECT_EQ(Names(log["torques"]), json({"tau.knee"}));
  EXPECT_EQ(log["motion"]["channels"][0]["unit"], "m");
  EXPECT_NEAR(log["signals"]["channels"][4]["min"].get<double>(), -0.01,
              1e-9);  // Rounding to float.
  EXPECT_TRUE(log["notes"].empty());
}

TEST(RunLog, OmitsColumnsThatThePageDoesNotShow) {
  const json log = ReadRunLog(
      Written("time[s],lambda.left_foot.fz[N],other.fx[N],push.fx[N],"
              "right_foot.mx[Nm],residual.momentum,self_contacts,status\n"
              "0,1,2,3,4,5,6,ok\n"));
  EXPECT_EQ(Names(log["motion"]), json({"right_foot.mx"}));
  EXPECT_EQ(Names(log["signals"]), json({"push.fx", "residual.momentum"}));
}

TEST(RunLog, PlotsAFootsForceInAllThreeAxes) {
  const json log = ReadRunLog(
      Written("time[s],paw.fx[N],paw.fy[N],paw.fz[N],paw.mz[Nm],lambda.paw.fy["
              "N]\n0,1,2,3,4,5\n"));
  EXPECT_EQ(Names(log["signals"]), json({"paw.fx", "paw.fy", "paw.fz"}));
}

TEST(RunLog, ReportsWhenLinksTouched) {
  const json log = ReadRunLog(
      Written("time[s],touching\n0,\n1,a|b\n2,a|b;c|d\n3,c|d\n4,\n"));
  EXPECT_EQ(log["touching"],
            json::parse(R"([["a|b", 1.0, 3.0], ["c|d", 2.0, 4.0]])"));
}

TEST(RunLog, ReportsWhenEachConstraintWasActive) {
  const json log =
      ReadRunLog(Written(std::string(kHeader) +
                         "0,0,0,0,0,0,0,0,ok,cop=2\n"
                         "0.5,0,0,0,0,0,0,0,ok,cop=-7.5;torque.knee.max=1\n"
                         "1,0,0,0,0,0,0,0,ok,\n"
                         "1.5,0,0,0,0,0,0,0,ok,\n"
                         "2,0,0,0,0,0,0,0,ok,cop=3\n"));
  EXPECT_EQ(log["active"],
            json({{{"name", "cop"},
                   {"peak", 7.5},
                   {"spans", {{0.0, 1.0, -7.5}, {2.0, 2.5, 3.0}}}},
                  {{"name", "torque.knee.max"},
                   {"peak", 1.0},
                   {"spans", {{0.5, 1.0, 1.0}}}}}));
}

TEST(RunLog, ReportsWhenTheStatusWasNotOk) {
  const json log =
      ReadRunLog(Written(std::string(kHeader) + "0,0,0,0,0,0,0,0,ok,\n"
                                                "1,0,0,0,0,0,0,0,fail_safe,\n"
                                                "2,0,0,0,0,0,0,0,fail_safe,\n"
                                                "3,0,0,0,0,0,0,0,ok,\n"));
  EXPECT_EQ(log["status"], json::parse(R"([["fail_safe", 1.0, 3.0]])"));
}

TEST(RunLog, ReadsCompleteRowsOfALogCutShort) {
  const json log = ReadRunLog(
      Written(std::string(kHeader) + "0,0,0,0,0,0,0,0,ok,\n0.001,0,0,0,0.0"));
  EXPECT_EQ(log["rows"], 1);
  EXPECT_EQ(log["notes"],
            json({"log.csv was cut short: its last row is incomplete."}));
}

TEST(RunLog, NotesThatThereAreNoRows) {
  const json log = ReadRunLog(Written(kHeader));
  EXPECT_EQ(log["rows"], 0);
  EXPECT_EQ(log["notes"], json({"log.csv has a header and no rows."}));
}

TEST(RunLog, RejectsInvalidLog) {
  const auto refusal = [](const std::string& text) -> std::string {
    const auto file = Written(text);
    try {
      ReadRunLog(file);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).substr(file.string().size());
    }
    return "accepted";
  };
  EXPECT_EQ(
      refusal(""),
      ": has no complete header, its run ended too early; run push again");
  EXPECT_EQ(refusal("POISELOG\1"),
            ": has no complete header, its run ended too early; run push "
            "again");  // A binary log, cut.
  EXPECT_EQ(refusal("a,b\n1,2\n"), ": has no column time");
  EXPECT_EQ(refusal("\x8f\xa3,\x01\n\xff"), ": has no column time");
  EXPECT_EQ(refusal("time[s],q.knee[rad]\n0,0.1\n1,0.l\n"),
            ":3: column 'q.knee[rad]' is '0.l', must be a number");
}

TEST(RunLog, StopsWhereTimeDoesNotAdvance) {
  const json log = ReadRunLog(Written("time[s]\n0\n1\n1\n2\n"));
  EXPECT_EQ(log["rows"], 2);
  EXPECT_EQ(log["notes"].size(), 1u);
  EXPECT_EQ(ReadRunLog(Written("time[s]\n0\nnan\n"))["rows"], 1);
}

TEST(RunLog, ReducesALongLogAndKeepsItsPeak) {
  std::string text = "time[s],com.x[m],q.knee[rad]\n";
  constexpr int kRows = 50000;
  for (int i = 0; i < kRows; ++i) {
    text += std::to_string(i) + (i == 31234 ? ",5,1\n" : ",0,1\n");
  }
  const json log = ReadRunLog(Written(text));
  EXPECT_EQ(log["rows"], kRows);
  EXPECT_LE(log["motion"]["rows"], 3400);
  EXPECT_GE(log["motion"]["rows"], 3000);
  EXPECT_LE(log["signals"]["rows"], 10000);
  EXPECT_GE(log["signals"]["rows"], 8000);
  EXPECT_EQ(log["signals"]["channels"][0]["max"], 5);
}

TEST(RunLog, RejectsMissingLog) {
  EXPECT_THROW(ReadRunLog("no/such/log.csv"), std::invalid_argument);
}

TEST(Timing, CountsTicksInControlPeriods) {
  const auto file = std::filesystem::path(testing::TempDir()) / "timing.csv";
  std::ofstream(file) << "tick,us,iterations\n0,180.5,3\n1,220,9\n";
  const json timing = ReadTiming(file, 0.002);
  EXPECT_EQ(timing["time"], EncodeFloats({0, 0.002f}));
  EXPECT_EQ(timing["channels"][0], EncodeChannel("us", "us", {180.5f, 220.0f}));
  EXPECT_EQ(timing["channels"][1], EncodeChannel("iterations", "", {3, 9}));
}

}  // namespace
}  // namespace poise
