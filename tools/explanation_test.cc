// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tools/explanation.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace poise {
namespace {

std::filesystem::path MakeRun(const std::string& name, const std::string& log,
                              const std::string& summary) {
  const std::filesystem::path run =
      std::filesystem::path(std::getenv("TEST_TMPDIR")) / name;
  std::filesystem::create_directories(run);
  std::ofstream(run / "log.csv") << log;
  std::ofstream(run / "summary.json") << summary;
  return run;
}

constexpr char kPushed[] =
    "time[s],status,active,lost,conflict\n"
    "0.61,ok,,,\n"
    "0.62,ok,left_foot.cop.y_max=12,momentum.ly=-3,newton_euler.my=1;"
    "newton_euler.fy=1;left_foot.cop.y_max=3;torque.l_knee=2;momentum.ly=4\n"
    "0.63,limit_relaxed,left_foot.cop.y_max=41;right_foot.unilateral.fz=2,"
    "momentum.ly=-12,newton_euler.my=1;"
    "newton_euler.fy=1;left_foot.cop.y_max=3;torque.l_knee=2;momentum.ly=4\n"
    "0.64,ok,left_foot.cop.y_max=5,,\n"
    "0.90,ok,left_foot.cop.y_max=7,,\n"
    "0.91,ok,,,\n";

TEST(Explanation, SaysWhenWhatAndWhy) {
  const nlohmann::json said =
      Explain(MakeRun("pushed", kPushed, R"({"recovered": true})"));
  ASSERT_EQ(said["rows"].size(), 3u);
  EXPECT_EQ(said["rows"][0]["name"], "left_foot.cop.y_max");
  EXPECT_EQ(said["rows"][0]["from"], 0.62);
  EXPECT_EQ(said["rows"][0]["to"], 0.64);
  EXPECT_EQ(said["rows"][0]["at"], 0.63);
  EXPECT_EQ(said["rows"][0]["multiplier"], 41);
  EXPECT_EQ(said["rows"][2]["from"], 0.90);
  ASSERT_EQ(said["losses"].size(), 1u);
  EXPECT_EQ(said["losses"][0]["amount"], -12);
  EXPECT_EQ(said["losses"][0]["unit"], "N");
  EXPECT_EQ(said["losses"][0]["because"][0], "left_foot.cop.y_max");
  ASSERT_EQ(said["status"].size(), 1u);
  EXPECT_EQ(said["status"][0]["name"], "limit_relaxed");
  EXPECT_EQ(said["sentences"][0],
            "0.620 s: the CoP of the left foot at its outer edge for 20 ms "
            "(multiplier 41 at 0.630 s).");
  EXPECT_EQ(said["sentences"].back(), "The robot recovered.");
}

TEST(Explanation, SaysOnceWhatContradictsItself) {
  const nlohmann::json said = Explain(MakeRun("conflict", kPushed, "{}"));
  ASSERT_EQ(said["conflicts"].size(), 2u);
  EXPECT_EQ(said["conflicts"][0]["at"], 0.62);
  ASSERT_EQ(said["conflicts"][0]["rows"].size(), 5u);
  EXPECT_EQ(said["conflicts"][0]["rows"][2]["name"], "left_foot.cop.y_max");
  EXPECT_EQ(said["conflicts"][0]["rows"][2]["rank"], 3);
  int times = 0;
  for (const std::string sentence : said["sentences"]) {
    if (sentence.find("cannot all be met") == std::string::npos) continue;
    ++times;
    EXPECT_EQ(
        sentence,
        "0.620 s: cannot all be met: momentum (rank 4); the CoP of the "
        "left foot at its outer edge (rank 3); the torque limit of l knee "
        "(rank 2); newton euler (rank 1).");
  }
  EXPECT_EQ(times, 1);
}

TEST(Explanation, SaysThatTheRobotFell) {
  const nlohmann::json said = Explain(
      MakeRun("fell", kPushed, R"({"recovered": false, "fell_at": 1.25})"));
  EXPECT_EQ(said["sentences"].back(), "The robot fell at 1.250 s.");
}

TEST(Explanation, LeavesOutWhatCameAfterAFall) {
  const nlohmann::json said = Explain(MakeRun(
      "fell_early",
      std::string(kPushed) +
          "0.915,ok,left_foot.cop.y_max=1,,\n0.93,ok,left_foot.cop.y_max=1,,\n",
      R"({"recovered": false, "fell_at": 0.7,
                          "fell_by": "a foot slid over 30 mm"})"));
  const size_t count = said["sentences"].size();
  EXPECT_EQ(said["sentences"][count - 2],
            "The robot fell at 0.700 s: a foot slid over 30 mm.");
  // The CoP at its edge again.
  EXPECT_EQ(said["sentences"][count - 1],
            "After that, 1 more; --json has its rows.");
  EXPECT_EQ(said["rows"].size(), 3u);
}

// A robot that still stands may still fall.
TEST(Explanation, DoesNotSayHowAnInterruptedRunWouldHaveEnded) {
  const nlohmann::json said = Explain(
      MakeRun("interrupted", kPushed,
              R"({"recovered": true, "fell_at": null, "interrupted": true,
                  "duration": 0.91})"));
  EXPECT_TRUE(said["recovered"].is_null());
  EXPECT_EQ(said["sentences"].back(),
            "The run was interrupted at 0.910 s, the robot still up: how it "
            "would have ended is not known.");
  EXPECT_EQ(Explain(MakeRun("interrupted_late", kPushed,
                            R"({"recovered": false, "fell_at": 1.25,
                                "interrupted": true})"))["sentences"]
                .back(),
            "The robot fell at 1.250 s.");
}

TEST(Explanation, TakesNoSummaryOfAnotherLog) {
  const nlohmann::json said =
      Explain(MakeRun("other_log", std::string(kPushed) + "0.92,o",
                      R"({"recovered": true, "fell_at": 0.7,
                          "log_sha256": "of the whole log"})"));
  EXPECT_TRUE(said["recovered"].is_null());
  EXPECT_TRUE(said["fell_at"].is_null());
  const size_t count = said["sentences"].size();
  EXPECT_EQ(said["sentences"][count - 3],
            "log.csv was cut short: its last row is not whole.");
  EXPECT_EQ(said["sentences"][count - 2],
            "summary.json is not of this log.csv, by its log_sha256: that is "
            "of another run, or was cut or changed.");
  EXPECT_EQ(said["sentences"][count - 1], "How it ended is not recorded.");
  EXPECT_EQ(said["notes"].size(), 2u);
}

TEST(Explanation, SaysThatThereAreNoRows) {
  const nlohmann::json said =
      Explain(MakeRun("no_rows", "time[s],status,active\n", "{}"));
  EXPECT_EQ(said["sentences"][0], "log.csv has a header and no rows.");
}

TEST(Explanation, SaysWhenAFootRollsOrSlides) {
  const nlohmann::json said = Explain(
      MakeRun("rolled",
              "time[s],status,active,left_foot.contact,left_foot.tilt[rad],"
              "left_foot.slide[m]\n"
              "0.1,ok,,1,0.019,0.0049\n0.2,ok,,0,0.5,0.5\n0.3,ok,,1,0.021,0\n"
              "0.4,ok,,1,0.03,0.0051\n",
              "{}"));
  ASSERT_EQ(said["sentences"].size(), 3u);
  EXPECT_EQ(said["sentences"][0],
            "0.300 s: the left foot rolls over an edge, tilted by more than "
            "0.02 rad.");
  EXPECT_EQ(said["sentences"][1],
            "0.400 s: the left foot has slid by more than 5 mm.");
}

TEST(Explanation, SaysOnceWhatSeveralRowsMean) {
  const nlohmann::json said = Explain(
      MakeRun("friction",
              "time[s],status,active,lost\n"
              "0.1,ok,left_foot.friction.x_max=1;left_foot.friction.y_max=2,\n"
              "0.2,ok,left_foot.friction.y_max=3,\n"
              "0.21,ok,left_foot.friction.x_min=4,\n",
              "{}"));
  EXPECT_EQ(said["rows"].size(), 4u);
  ASSERT_EQ(said["sentences"].size(), 2u);
  EXPECT_EQ(said["sentences"][0],
            "0.200 s: the left foot at its friction limit for 10 ms "
            "(multiplier 4 at 0.210 s).");
}

TEST(Explanation, RefusesWhatIsNoRun) {
  EXPECT_THROW(Explain("nowhere"), std::invalid_argument);
  EXPECT_THROW(Explain(MakeRun("other", "a,b\n1,2\n", "{}")),
               std::invalid_argument);
  const std::filesystem::path garbled =
      MakeRun("garbled", "time[s],com.x[m],status,active\n0,0.0a1,ok,\n", "{}");
  try {
    Explain(garbled);
    ADD_FAILURE() << "a letter among digits is taken for a number";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(error.what(),
              (garbled / "log.csv").string() +
                  ":2: column 'com.x[m]' is '0.0a1', must be a number");
  }
}

TEST(Explanation, NamesEdgesAsAPersonDoes) {
  EXPECT_EQ(DescribeRow("right_foot.cop.y_max"),
            "the CoP of the right foot at its inner edge");
  EXPECT_EQ(DescribeRow("right_foot.cop.y_min"),
            "the CoP of the right foot at its outer edge");
  EXPECT_EQ(DescribeRow("left_foot.cop.x_min"),
            "the CoP of the left foot at its rear edge");
  EXPECT_EQ(DescribeRow("torque.l_knee.max"),
            "the torque of l knee at its upper limit");
  EXPECT_EQ(DescribeRow("joint.l_knee.min"),
            "the angle of l knee at its lower limit");
}

}  // namespace
}  // namespace poise
