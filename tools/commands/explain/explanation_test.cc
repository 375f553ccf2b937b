// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/explanation.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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

// Returns descriptions of rows as in a summary: name, unit, phrase, kind, task.
const nlohmann::json& Rows() {
  static const nlohmann::json rows = [] {
    nlohmann::json object;
    const auto add = [&](const std::string& name, const char* unit,
                         const std::string& phrase, const char* kind,
                         const char* task) {
      object[name] = {
          {"unit", unit}, {"phrase", phrase}, {"kind", kind}, {"task", task}};
    };
    for (const std::string foot : {"left", "right"}) {
      const std::string the = "the " + foot + " foot";
      const bool is_left = foot == "left";
      add(foot + "_foot.cop.x_max", "N m",
          "the CoP of " + the + " at its front edge", "cop_limit", "cop");
      add(foot + "_foot.cop.y_max", "N m",
          "the CoP of " + the +
              (is_left ? " at its outer edge" : " at its inner edge"),
          "cop_limit", "cop");
      for (const char* side : {"x_max", "x_min", "y_max", "y_min"}) {
        add(foot + "_foot.friction." + side, "N",
            the + " at its friction limit", "friction_limit", "friction");
      }
    }
    add("joint.l_knee.max", "rad", "the angle of l knee at its upper limit",
        "joint_limit", "joint_limits");
    add("torque.l_knee.max", "N m", "the torque of l knee at its upper limit",
        "torque_limit", "torque_limits");
    for (const char* axis : {"x", "y", "z"}) {
      const std::string along = std::string(" along ") + axis;
      add(std::string("momentum.l") + axis, "N", "the linear momentum" + along,
          "target", "momentum");
      add(std::string("com.") + axis, "m/s2", "the center of mass" + along,
          "target", "com");
    }
    for (const char* row : {"mx", "my", "mz", "fx", "fy", "fz"}) {
      add(std::string("newton_euler.") + row, "N", "the balance of forces",
          "dynamics", "newton_euler");
    }
    return object;
  }();
  return rows;
}

// Returns a summary with the descriptions of Rows().
std::string Described(const std::string& summary = R"({"recovered": null})") {
  nlohmann::json json = nlohmann::json::parse(summary);
  json["rows"] = Rows();
  return json.dump();
}

constexpr char kPushed[] =
    "time[s],status,active,lost,conflict\n"
    "0.61,ok,,,\n"
    "0.62,ok,left_foot.cop.y_max=12,momentum.ly=-3,newton_euler.my=1;"
    "newton_euler.fy=1;left_foot.cop.y_max=3;torque.l_knee.max=2;momentum.ly="
    "4\n"
    "0.63,limit_relaxed,left_foot.cop.y_max=41;right_foot.unilateral.fz=2,"
    "momentum.ly=-12,newton_euler.my=1;"
    "newton_euler.fy=1;left_foot.cop.y_max=3;torque.l_knee.max=2;momentum.ly="
    "4\n"
    "0.64,ok,left_foot.cop.y_max=5,,\n"
    "0.90,ok,left_foot.cop.y_max=7,,\n"
    "0.91,ok,,,\n";

TEST(Explanation, ReportsTimesRowsAndCauses) {
  const nlohmann::json said =
      Explain(MakeRun("pushed", kPushed, Described(R"({"recovered": true})")));
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
            "0.620 s: active constraint: the CoP of the left foot at its outer "
            "edge for 30 ms (largest multiplier 41 at 0.630 s).");
  EXPECT_EQ(said["sentences"].back(), "The robot recovered.");
}

TEST(Explanation, PrintsRepeatedConflictOnce) {
  const nlohmann::json said =
      Explain(MakeRun("conflict", kPushed, Described()));
  ASSERT_EQ(said["conflicts"].size(), 2u);
  EXPECT_EQ(said["conflicts"][0]["at"], 0.62);
  ASSERT_EQ(said["conflicts"][0]["rows"].size(), 5u);
  EXPECT_EQ(said["conflicts"][0]["rows"][2]["name"], "left_foot.cop.y_max");
  EXPECT_EQ(said["conflicts"][0]["rows"][2]["level"], 3);
  EXPECT_EQ(said["conflicts"][0]["rows"][2]["rank"], 3);  // The alias.
  int times = 0;
  for (const std::string sentence : said["sentences"]) {
    if (sentence.find("contradict each other") == std::string::npos) continue;
    ++times;
    EXPECT_EQ(
        sentence,
        "0.620 s: these requirements contradict each other: momentum (level "
        "4); the CoP of the left foot at its outer edge (level 3); the torque "
        "of l knee at its "
        "upper limit (level 2); newton euler (level 1).");
  }
  EXPECT_EQ(times, 1);
}

TEST(Explanation, ReportsTheFall) {
  const nlohmann::json said = Explain(
      MakeRun("fell", kPushed, R"({"recovered": false, "fell_at": 1.25})"));
  EXPECT_EQ(said["sentences"].back(), "The robot fell at 1.250 s.");
}

TEST(Explanation, NamesASettingThatAllowsTheFall) {
  const auto ending = [](const std::string& fell_by, const std::string& keys) {
    const nlohmann::json said = Explain(
        MakeRun("setting", kPushed,
                R"({"recovered": false, "fell_at": 1.25, "fell_by": ")" +
                    fell_by + "\", " + keys + "}"));
    return said["sentences"].back().get<std::string>();
  };
  const std::string tilted = "a foot tilted over 0.1 rad";
  const std::string slid = "a foot slid over 30 mm";
  const std::string fell = "The robot fell at 1.250 s: ";
  const std::string cop = R"("tasks": {"without": ["yaw", "cop"], "with": []})";
  EXPECT_EQ(ending(tilted, cop),
            fell + tilted +
                ". The task `cop` was switched off, which keeps the CoP inside "
                "the soles: with it, the robot may recover.");
  EXPECT_EQ(ending(slid, R"("tasks": {"without": ["friction"]})"),
            fell + slid +
                ". The task `friction` was switched off, which keeps the "
                "forces inside the friction cones: with it, the robot may "
                "recover.");
  for (const char* tasks :
       {R"({"without": ["cop"], "with": ["zmp"]})", R"({"without": []})",
        R"({"without": ["friction"]})", "{}", "null", "3"}) {
    EXPECT_EQ(ending(tilted, R"("tasks": )" + std::string(tasks)),
              fell + tilted + ".")
        << tasks;
  }
  EXPECT_EQ(ending(slid, R"("tasks": {"without": ["cop"]})"),
            fell + slid + ".");
  EXPECT_EQ(ending(tilted, cop + R"(, "sensor_noise": 100)"),
            fell + tilted +
                ". The sensors had 100 times the usual noise: with less, the "
                "robot may recover.");
  // No setting makes the robot recover from such a push.
  EXPECT_EQ(ending(tilted, cop + R"(, "impulse_Ns": 750, "lipm_height_Ns": 17,
                                "step_Ns": 20)"),
            fell + tilted + ".");
}

TEST(Explanation, OmitsEventsAfterAFall) {
  const nlohmann::json said = Explain(MakeRun(
      "fell_early",
      std::string(kPushed) +
          "0.915,ok,left_foot.cop.y_max=1,,\n0.93,ok,left_foot.cop.y_max=1,,\n",
      R"({"recovered": false, "fell_at": 0.7,
                          "fell_by": "a foot slid over 30 mm"})"));
  const size_t count = said["sentences"].size();
  EXPECT_EQ(said["sentences"][count - 2],
            "The robot fell at 0.700 s: a foot slid over 30 mm.");
  // The omitted event is the CoP at its edge again.
  EXPECT_EQ(said["sentences"][count - 1],
            "Events after the fall: 1. --json lists them.");
  EXPECT_EQ(said["rows"].size(), 3u);
}

// A robot that stands when the run is interrupted could have fallen later.
TEST(Explanation, GivesNoOutcomeForInterruptedRun) {
  const nlohmann::json said = Explain(
      MakeRun("interrupted", kPushed,
              R"({"recovered": true, "fell_at": null, "interrupted": true,
                  "duration": 0.91})"));
  EXPECT_TRUE(said["recovered"].is_null());
  EXPECT_EQ(said["sentences"].back(),
            "The run was interrupted at 0.910 s while the robot was still "
            "standing: the outcome is not known.");
  EXPECT_EQ(Explain(MakeRun("interrupted_late", kPushed,
                            R"({"recovered": false, "fell_at": 1.25,
                                "interrupted": true})"))["sentences"]
                .back(),
            "The robot fell at 1.250 s.");
}

TEST(Explanation, SaysThatTheRunEndsTooSoonAfterThePush) {
  EXPECT_EQ(Explain(MakeRun("soon", kPushed,
                            R"({"recovered": false, "fell_at": null,
                                "time_after_push": -0.05})"))["sentences"]
                .back(),
            "The run ends 0.05 s before the end of the push: too early to "
            "tell whether the robot recovers.");
  EXPECT_EQ(Explain(MakeRun("late", kPushed,
                            R"({"recovered": false, "fell_at": null,
                                "time_after_push": 0.5})"))["sentences"]
                .back(),
            "The robot did not fall, but did not return to its reference.");
}

// Without descriptions of rows, their names tell forces and limits.
TEST(Explanation, NamesLimitsWithoutASummary) {
  const auto run = MakeRun("no_summary", kPushed, "");
  std::filesystem::remove(run / "summary.json");
  const nlohmann::json said = Explain(run);
  EXPECT_EQ(said["story"],
            nlohmann::json(
                {"summary.json does not exist. So the outcome of the run is "
                 "not known, and rows have their names in the log.",
                 "0.620 s: the most costly limit is reached: "
                 "left_foot.cop.y_max, for 30 ms.",
                 "0.620 s: the momentum task misses its target by up to 12 N "
                 "at 0.630 s, because of left_foot.cop.y_max (100 %).",
                 "The end of the run is not recorded."}));
  EXPECT_EQ(said["notes"][0], said["story"][0]);
}

TEST(Explanation, IgnoresSummaryOfAnotherLog) {
  const nlohmann::json said =
      Explain(MakeRun("other_log", std::string(kPushed) + "0.92,o",
                      R"({"recovered": true, "fell_at": 0.7,
                          "log_sha256": "of the whole log"})"));
  EXPECT_TRUE(said["recovered"].is_null());
  EXPECT_TRUE(said["fell_at"].is_null());
  EXPECT_EQ(said["sentences"][0],
            "summary.json does not belong to this log.csv: its log_sha256 "
            "differs. The log is of another run, or was cut short or changed. "
            "So the outcome of the run is not known, and rows have their names "
            "in the log.");
  EXPECT_EQ(said["story"][0], said["sentences"][0]);
  const size_t count = said["sentences"].size();
  EXPECT_EQ(said["sentences"][count - 2],
            "log.csv was cut short: its last row is incomplete.");
  EXPECT_EQ(said["sentences"][count - 1],
            "The end of the run is not recorded.");
  EXPECT_EQ(said["notes"].size(), 2u);
}

TEST(Explanation, ReportsLogWithoutRows) {
  const nlohmann::json said = Explain(
      MakeRun("no_rows", "time[s],status,active\n", R"({"recovered": null})"));
  EXPECT_EQ(said["sentences"][0], "log.csv has a header and no rows.");
}

TEST(Explanation, ReportsFootThatRollsOrSlides) {
  const nlohmann::json said = Explain(
      MakeRun("rolled",
              "time[s],status,active,left_foot.contact,left_foot.tilt[rad],"
              "left_foot.slide[m]\n"
              "0.1,ok,,1,0.019,0.0049\n0.2,ok,,0,0.5,0.5\n0.3,ok,,1,0.021,0\n"
              "0.4,ok,,1,0.03,0.0051\n",
              R"({"recovered": null})"));
  ASSERT_EQ(said["sentences"].size(), 3u);
  EXPECT_EQ(said["sentences"][0],
            "0.300 s: the left foot rolls over an edge, tilted by more than "
            "0.02 rad.");
  EXPECT_EQ(said["sentences"][1],
            "0.400 s: the left foot has slid by more than 5 mm.");
}

// The log has the planned place of a step, summary.json the place of the
// landing.
TEST(Explanation, SaysThatThePlaceOfAStepIsPlanned) {
  const nlohmann::json said = Explain(
      MakeRun("stepped",
              "time[s],status,active,left_foot.phase,plan.x[m],plan.y[m],"
              "plan.beyond[m]\n"
              "0.1,ok,,down,,,\n0.2,ok,,stepping,0.18,0.47,0.035\n"
              "0.3,ok,,stepping,0.18,0.47,0.035\n0.4,ok,,down,,,\n",
              R"({"recovered": true})"));
  EXPECT_EQ(said["story"][0],
            "0.200 s: the robot steps with the left foot, planned to (0.18, "
            "0.47) m, in 0.20 s, as the capture point is 4 cm beyond the "
            "edge.");
}

TEST(Explanation, PrintsRowsWithTheSamePhraseOnce) {
  const nlohmann::json said = Explain(
      MakeRun("friction",
              "time[s],status,active,lost\n"
              "0.1,ok,left_foot.friction.x_max=1;left_foot.friction.y_max=2,\n"
              "0.101,ok,,\n"
              "0.2,ok,left_foot.friction.y_max=3,\n"
              "0.21,ok,left_foot.friction.x_min=4,\n",
              Described()));
  EXPECT_EQ(said["rows"].size(), 4u);
  ASSERT_EQ(said["sentences"].size(), 2u);
  EXPECT_EQ(said["sentences"][0],
            "0.200 s: active constraint: the left foot at its friction limit "
            "for 11 ms (largest multiplier 4 at 0.210 s).");
}

TEST(Explanation, RejectsFolderWithoutValidLog) {
  EXPECT_THROW(Explain("nowhere"), std::invalid_argument);
  EXPECT_THROW(
      Explain(MakeRun("other", "a,b\n1,2\n", R"({"recovered": null})")),
      std::invalid_argument);
  const std::filesystem::path garbled =
      MakeRun("garbled", "time[s],com.x[m],status,active\n0,0.0a1,ok,\n",
              R"({"recovered": null})");
  try {
    Explain(garbled);
    ADD_FAILURE() << "0.0a1 was accepted as a number";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(error.what(),
              (garbled / "log.csv").string() +
                  ":2: column 'com.x[m]' is '0.0a1', must be a number");
  }
}

TEST(Explanation, ReportsPhasesOfTheFeet) {
  const nlohmann::json said =
      Explain(MakeRun("let_go",
                      "time[s],status,active,left_foot.phase,right_foot.phase\n"
                      "0,ok,,down,lost\n0.45,ok,,free,lost\n0.5,ok,,free,down\n"
                      "1.65,ok,,returning,down\n2.1,ok,,loading,down\n"
                      "2.4,ok,,down,unloading\n2.7,ok,,down,up\n",
                      R"({"recovered": null})"));
  ASSERT_EQ(said["stance"].size(), 9u);
  EXPECT_EQ(said["stance"][1],
            nlohmann::json::parse(R"({"foot": "left_foot", "phase": "free",
                                      "from": 0.45, "to": 0.5})"));
  const std::vector<std::string> sentences = said["sentences"];
  EXPECT_EQ(sentences,
            (std::vector<std::string>{
                "0.000 s: the right foot has lost contact with the ground, for "
                "0.5 s.",
                "0.450 s: the left foot is released, for 1.2 s.",
                "0.500 s: the right foot is down again.",
                "1.650 s: the left foot returns to its place, for 0.45 s.",
                "2.100 s: the left foot has landed and is loaded, for 0.3 s.",
                "2.400 s: the left foot is down again.",
                "2.400 s: the right foot is unloaded, for 0.3 s.",
                "2.700 s: the right foot is lifted.",
                "The end of the run is not recorded."}));
}

TEST(Explanation, ReportsReasonOfFailSafe) {
  const nlohmann::json said = Explain(
      MakeRun("froze",
              "time[s],status,active,reason\n0,ok,,\n0.1,fail_safe,,clock\n"
              "0.11,fail_safe,,clock\n0.5,fail_safe,,state\n"
              "0.9,fail_safe,,no_answer\n1.3,limit_relaxed,,\n",
              R"({"recovered": null})"));
  ASSERT_EQ(said["status"].size(), 4u);
  EXPECT_EQ(said["status"][0]["name"], "fail_safe");
  EXPECT_EQ(said["status"][0]["reason"], "clock");
  EXPECT_EQ(said["status"][0]["to"], 0.11);
  EXPECT_EQ(said["status"][3]["name"], "limit_relaxed");
  EXPECT_TRUE(said["status"][3]["reason"].is_null());
  EXPECT_EQ(said["sentences"][0],
            "0.100 s: the controller reports fail safe until 0.110 s: the time "
            "of the robot's state stands still.");
  EXPECT_EQ(said["sentences"][1],
            "0.500 s: the controller reports fail safe until 0.500 s: the "
            "robot's state is invalid (not finite, too large, or the "
            "quaternion is not normalized).");
  EXPECT_EQ(said["sentences"][2],
            "0.900 s: the controller reports fail safe until 0.900 s: the "
            "solver has no solution that satisfies the dynamics, or a row is "
            "not finite.");
  EXPECT_EQ(said["sentences"][3],
            "1.300 s: the controller reports limit relaxed until 1.300 s.");
}

// A list of dozens of joints at their limits would explain nothing. The order
// is that of the multipliers, not that of the levels.
TEST(Explanation, NamesFiveCausesWithTheLargestMultipliers) {
  std::string active, conflict = "momentum.ly=4";
  for (int i = 0; i < 42; ++i) {
    const std::string row = "torque.j" + std::to_string(i);
    active += row + ".max=" + std::to_string(i + 1) + ";";
    conflict += ";" + row + ".max=2";
  }
  const std::string head = "time[s],status,active,lost,conflict\n0.1,ok,";
  const std::string loss = ",momentum.ly=-12,";
  std::vector<std::string> spoken;
  for (const std::string& cell : {std::string(), conflict}) {
    const nlohmann::json said = Explain(
        MakeRun("causes" + std::to_string(cell.size()),
                head + active + "torque.late.min=0.5" + loss + cell + "\n",
                R"({"recovered": null})"));
    // Without a conflict the active constraints need not be the cause.
    const nlohmann::json all =
        said["losses"][0][cell.empty() ? "while" : "because"];
    EXPECT_TRUE(said["losses"][0][cell.empty() ? "because" : "while"].empty());
    EXPECT_EQ(all.size(), cell.empty() ? 43u : 42u);
    EXPECT_EQ(all[0], "torque.j41.max");
    EXPECT_EQ(all[41], "torque.j0.max");
    spoken.push_back(said["sentences"][0]);
    if (!cell.empty()) {
      EXPECT_EQ(said["conflicts"][0]["rows"].size(), 43u);
      const std::string text = said["sentences"][1];
      EXPECT_NE(text.find("j8.max (level 2) and 33 more."), std::string::npos)
          << text;
    }
  }
  const std::string begin =
      "0.100 s: momentum.ly missed its target by up to 12 N (at 0.100 s), ";
  const std::string five =
      "torque.j41.max, torque.j40.max, torque.j39.max, torque.j38.max, "
      "torque.j37.max and ";
  EXPECT_EQ(spoken[0], begin + "with active constraints " + five +
                           "38 more (perhaps not the cause).");
  EXPECT_EQ(spoken[1], begin + "because of " + five + "37 more.");
}

// If a conflict has no constraints, tasks of the same or a higher level are the
// cause.
TEST(Explanation, NamesTasksAsCauseIfNoConstraintConflicts) {
  const nlohmann::json said = Explain(MakeRun(
      "before",
      "time[s],status,active,lost,conflict\n"
      "1.600,ok,,,momentum.lx=5;joint.l_knee.max=2\n"
      "1.650,ok,left_foot.friction.x_max=1,momentum.lx=9,"
      "momentum.lx=5;posture.l_knee=4;posture.r_knee=4;newton_euler.fx=1\n"
      "1.667,ok,left_foot.friction.x_max=1,momentum.lx=47.4;com.x=2,\n"
      "1.700,ok,,,frame.hand.vx=6;left_foot.cop.x_max=3\n",
      Described()));
  ASSERT_EQ(said["losses"].size(), 2u);
  EXPECT_EQ(
      said["losses"][0]["because"],
      (nlohmann::json{"posture.l_knee", "posture.r_knee", "newton_euler.fx"}));
  std::vector<std::string> losses;
  for (const std::string sentence : said["sentences"]) {
    if (sentence.find("missed") != std::string::npos) {
      losses.push_back(sentence);
    }
  }
  EXPECT_EQ(
      losses,
      (std::vector<std::string>{
          "1.650 s: the linear momentum along x missed its target by up to "
          "47.4 "
          "N (at 1.667 s), because of "
          "posture (level 4), newton euler (level 1).",
          "1.667 s: the center of mass along x missed its target by up to 2 "
          "m/s2 (at 1.667 s), because of "
          "momentum (level 5), posture (level 4), newton euler (level 1)."}));
}

// A task that a user adds has any name. Unit and phrase come from the summary.
TEST(Explanation, PrintsUnitAndPhraseOfAUsersTask) {
  const nlohmann::json said =
      Explain(MakeRun("users_task",
                      "time[s],status,active,lost,conflict\n"
                      "0,ok,warm.room.max=3,base_still.x=2,"
                      "warm.room.max=3;base_still.x=4\n"
                      "0.01,ok,warm.room.max=3,base_still.x=1,\n",
                      R"({"recovered": null, "rows": {
                "base_still.x": {"unit": "rad/s2", "kind": "target",
                    "phrase": "the rotation of the base about x",
                    "task": "base_still"},
                "warm.room.max": {"unit": "K", "kind": "limit",
                    "phrase": "the heat of the room at its upper limit",
                    "task": "warm"}}})"));
  EXPECT_EQ(said["losses"][0]["unit"], "rad/s2");
  EXPECT_EQ(said["losses"][0]["because"], nlohmann::json{"warm.room.max"});
  EXPECT_EQ(
      said["sentences"][1],
      "0.000 s: the rotation of the base about x missed its target by up "
      "to 2 rad/s2 (at 0.000 s), because of the heat of the room at its upper "
      "limit.");
}

// Summaries of older versions do not describe their rows.
TEST(Explanation, NamesUnknownConstraintAsCause) {
  const nlohmann::json said =
      Explain(MakeRun("unknown_row",
                      "time[s],status,active,lost,conflict\n"
                      "0.1,ok,tether.length=3,momentum.lx=12,"
                      "newton_euler.fx=1;tether.length=3;momentum.lx=4\n",
                      Described()));
  EXPECT_EQ(said["losses"][0]["because"], nlohmann::json{"tether.length"});
  EXPECT_EQ(said["sentences"][0],
            "0.100 s: the linear momentum along x missed its target by up to "
            "12 N (at 0.100 s), because of tether.length.");
  EXPECT_EQ(said["causes"][0]["rows"][0]["phrase"], "tether.length");
}

// A span includes its last tick. Otherwise a span of one tick at 20 Hz would
// last 0 ms and would get no sentence.
TEST(Explanation, CountsDurationToTheEndOfTheLastTick) {
  const auto sentences = [](const std::string& name, const std::string& rows) {
    const std::vector<std::string> said = Explain(MakeRun(
        name, "time[s],status,active,lost\n" + rows, Described()))["sentences"];
    return said;
  };
  EXPECT_EQ(sentences("slow",
                      "0,ok,,\n0.05,ok,torque.l_knee.max=1,\n"
                      "0.1,ok,torque.l_knee.max=2,\n0.15,ok,,\n"
                      "0.2,ok,,\n0.25,ok,torque.l_knee.max=2,\n")[0],
            "0.050 s: active constraint: the torque of l knee at its upper "
            "limit for 100 ms (largest multiplier 2 at 0.100 s).");
  const std::string quick = "0,ok,,\n0.001,ok,torque.l_knee.max=1,\n";
  EXPECT_EQ(sentences("quick", quick + "0.002,ok,,\n")[0],
            "No event lasted for 5 ms; --json lists 1 row that became active.");
  EXPECT_EQ(sentences("small", quick + "0.002,ok,joint.l_knee.max=1,com.x=0.1;"
                                       "com.y=0.1\n")[0],
            "No event lasted for 5 ms; --json lists 2 rows that became active "
            "and 2 rows that missed a target by less than 0.5.");
  EXPECT_EQ(sentences("clear", "0,ok,,\n0.05,ok,,\n")[0],
            "No constraint was active, and every task reached its target.");
}

TEST(Explanation, ReportsPushesAndTouchingLinks) {
  const nlohmann::json said = Explain(
      MakeRun("pushed_and_touched",
              "time[s],push.fx[N],push.fy[N],push.fz[N],touching,status,"
              "active\n0.999,0,0,0,,ok,\n1.000,0,0,0,,ok,\n"
              "1.001,100,133.6,0,,ok,\n1.002,100,133.6,0,l_hand|r_thigh,ok,\n"
              "1.003,0,0,0,l_hand|r_thigh,ok,\n1.004,0,-3,4,,ok,\n"
              "1.005,0,0,0,,ok,\n",
              R"({"recovered": true})"));
  const std::vector<std::string> sentences = said["sentences"];
  EXPECT_EQ(sentences, (std::vector<std::string>{
                           "1.001 s: the robot is pushed with 167 N, for 2 ms.",
                           "1.002 s: l hand touches r thigh, for 2 ms.",
                           "1.004 s: the robot is pushed with 5 N, for 1 ms.",
                           "No constraint was active, and every task reached "
                           "its target.",
                           "The robot recovered."}));
  ASSERT_EQ(said["pushes"].size(), 2u);
  EXPECT_EQ(said["pushes"][0],
            nlohmann::json::parse(R"({"from": 1.001, "to": 1.002, "at": 1.002,
                                      "force": [100.0, 133.6, 0.0]})"));
  EXPECT_EQ(said["touches"],
            nlohmann::json::parse(R"([{"links": ["l_hand", "r_thigh"],
                                       "from": 1.002, "to": 1.003}])"));
}

TEST(Explanation, NamesEachPushInTheStory) {
  const auto story = [](int pushes) {
    std::string log =
        "time[s],push.fx[N],push.fy[N],push.fz[N],status,active\n";
    for (int i = 0; i < pushes; ++i) {
      log += "0." + std::to_string(i) + "00,10,0,0,ok,\n0." +
             std::to_string(i) + "01,0,0,0,ok,\n";
    }
    return Explain(MakeRun("pushes" + std::to_string(pushes), log,
                           R"({"recovered": true})"))["story"][0];
  };
  EXPECT_EQ(story(1),
            "0.000 s: the robot is pushed forward with 10 N for 1 ms.");
  EXPECT_EQ(story(2),
            "0.000 s: the robot is pushed forward with 10 N for 1 ms and at "
            "0.100 s forward with 10 N for 1 ms.");
  EXPECT_EQ(story(6),
            "0.000 s: the robot is pushed forward with 10 N for 1 ms, at "
            "0.100 s forward with 10 N for 1 ms, at 0.200 s forward with 10 N "
            "for 1 ms, at 0.300 s forward with 10 N for 1 ms and 2 more "
            "times.");
}

// The log has steps of the feet also while the robot is falling.
TEST(Explanation, TellsNoStepAfterTheFall) {
  const auto log = [](const char* landing) {
    return std::string(
               "time[s],status,active,lost,left_foot.contact,left_foot.phase\n"
               "0.10,ok,,,1,down\n0.11,ok,,,0,stepping\n0.12,ok,,,0,stepping\n"
               "0.13,ok,,,0,stepping\n") +
           landing;
  };
  const std::string lands = "0.14,ok,,,1,landing\n0.15,ok,,,1,down\n";
  const auto story = [&](const std::string& rows, const char* fell_at) {
    const nlohmann::json said = Explain(MakeRun(
        "falling", log(rows.c_str()),
        std::string(R"({"recovered": false, "fell_at": )") + fell_at + "}"));
    std::string text;
    for (const std::string sentence : said["story"]) text += sentence + "\n";
    return text;
  };
  EXPECT_NE(story(lands, "0.2").find("steps with the left foot in 0.03 s"),
            std::string::npos)
      << story(lands, "0.2");
  EXPECT_NE(story(lands, "0.125").find("and does not land"), std::string::npos)
      << story(lands, "0.125");
  EXPECT_EQ(story(lands, "0.105").find("steps with"), std::string::npos);
}

TEST(Explanation, SaysThatACommandWasNotDone) {
  const nlohmann::json said = Explain(MakeRun(
      "not_done", kPushed, R"({"recovered": true, "commanded_done": false})"));
  EXPECT_EQ(said["sentences"].back(),
            "The robot recovered, but the commanded motion did not happen.");
}

TEST(Explanation, SaysThatAPushWasCutShort) {
  const auto pushed = [](const char* planned) {
    const nlohmann::json said = Explain(
        MakeRun("cut_short",
                "time[s],push.fx[N],push.fy[N],push.fz[N],status,active,lost\n"
                "0.10,5000,0,0,ok,,\n0.12,5000,0,0,ok,,\n",
                std::string(R"({"recovered": false, "fell_at": 0.14,
                  "impulse_Ns": 750, "pushes": [{"duration": )") +
                    planned + "}]}"));
    return said["story"][0].get<std::string>();
  };
  EXPECT_EQ(pushed("0.15"),
            "0.100 s: the robot is pushed forward with 5000 N for 40 ms of the "
            "planned 150 ms, in all an impulse of 750.0 N s.");
  EXPECT_EQ(pushed("0.04"),
            "0.100 s: the robot is pushed forward with 5000 N for 40 ms, an "
            "impulse of 750.0 N s.");
}

TEST(Explanation, TellsTheStoryInOrderOfTime) {
  const nlohmann::json said = Explain(MakeRun(
      "ordered",
      "time[s],status,active,lost,left_foot.contact,left_foot.tilt[rad],"
      "left_foot.slide[m]\n"
      "0.1,ok,,,1,0.03,0\n"
      "0.2,ok,left_foot.cop.x_max=1,momentum.lx=10,1,0,0\n",
      Described(R"({"recovered": true})")));
  const std::vector<std::string> story = said["story"];
  ASSERT_EQ(story.size(), 4u);
  EXPECT_EQ(story[0].substr(0, 28), "0.100 s: the left foot rolls");
  EXPECT_EQ(story[1].substr(0, 28), "0.200 s: the most costly lim");
}

// The knees reach their limits as a consequence of the fall, so they are not
// named.
TEST(Explanation, SummarizesAFallInOrderOfCause) {
  std::string log =
      "time[s],push.fx[N],push.fy[N],push.fz[N],left_foot.fz[N],"
      "right_foot.fz[N],status,active,lost,conflict\n";
  for (int i = 0; i < 30; ++i) {
    log += "0." + std::to_string(10 + i) + ",0,0,0,200,200,ok,,,\n";
  }
  log +=
      "0.40,300,0,0,200,200,ok,left_foot.cop.x_max=1;right_foot.cop.x_max=1,"
      "momentum.lx=100,newton_euler.fx=1;left_foot.cop.x_max=3;"
      "right_foot.cop.x_max=3;momentum.lx=4\n"
      "0.41,300,0,0,200,200,ok,left_foot.cop.x_max=1;right_foot.cop.x_max=1;"
      "joint.l_knee.max=9000,momentum.lx=200,\n"
      "0.42,0,0,0,200,200,ok,left_foot.cop.x_max=1;right_foot.cop.x_max=1;"
      "joint.l_knee.max=90000,momentum.lx=1580,"
      "joint.l_knee.max=2;momentum.lx=4\n"
      "0.43,0,0,0,200,200,ok,left_foot.cop.x_max=1;joint.l_knee.max=90000,"
      "momentum.lx=1600,\n";
  const nlohmann::json said = Explain(
      MakeRun("story", log, Described(R"({"recovered": false, "fell_at": 0.425,
          "fell_by": "a foot tilted over 0.1 rad", "impulse_Ns": 6,
          "lipm_height_Ns": 4})")));
  const std::vector<std::string> story = said["story"];
  EXPECT_EQ(
      story,
      (std::vector<std::string>{
          "0.400 s: the robot is pushed forward with 300 N for 20 ms, an "
          "impulse of 6.0 N s.",
          "0.400 s: the most costly limit is reached: the CoP of the left "
          "foot at its front edge and the CoP of the right foot at its "
          "front edge, until the fall.",
          "0.400 s: the momentum task misses its target by up to 1580 N at "
          "0.420 s, because of the CoP of the left foot at its front edge "
          "and the CoP of the right foot at its front edge (100 %).",
          "The robot fell at 0.425 s: a foot tilted over 0.1 rad.",
          "A step or larger soles may have helped; so may a smaller "
          "push: its impulse was 6.0 N s, a pendulum on these feet recovers "
          "from 4.0 N s."}));
  EXPECT_GT(said["sentences"].size(), story.size());
  const auto advice = [&](const std::string& step_Ns,
                          const std::string& bearable = "1") {
    const nlohmann::json far = Explain(MakeRun(
        "far", log,
        Described(R"({"recovered": false, "fell_at": 0.425,
          "impulse_Ns": 6, "step_Ns": )" +
                  step_Ns + R"(, "lipm_height_Ns": )" + bearable + "}")));
    return far["story"].back().get<std::string>();
  };
  EXPECT_EQ(advice("2.9"),
            "Only a smaller push would have helped: its impulse was 6.0 N s, a "
            "pendulum recovers from 1.0 N s on these feet, and from 2.9 N s "
            "with one step.");
  // The log has no moments, so that no cause is known.
  EXPECT_EQ(advice(R"(3.1, "pushes": [{"moment": [0, 0, 9]}])"),
            "The robot fell at 0.425 s.");
  EXPECT_NE(advice(R"(3.1, "pushes": [{"moment": [0, 0, 0]}])"),
            "The robot fell at 0.425 s.");
  EXPECT_EQ(advice(R"(3.1, "sensor_noise": 2)"),
            "The robot fell at 0.425 s. The sensors had 2 times the usual "
            "noise: with less, the robot may recover.");
  // The legs reach no place for a step, so that only the feet count.
  EXPECT_EQ(advice("0", "3.1").substr(0, 38),
            "A step or larger soles may have helped");
  EXPECT_EQ(advice("0"),
            "Only a smaller push would have helped: its impulse was 6.0 N s, a "
            "pendulum recovers from 1.0 N s on these feet, and the legs reach "
            "no place for a step.");
  EXPECT_EQ(advice("3.1"),
            "A step or larger soles may have helped; so may a smaller "
            "push: its impulse was 6.0 N s, a pendulum on these feet recovers "
            "from 1.0 N s.");
}

TEST(Explanation, NamesSlipAsCauseOfAFall) {
  const nlohmann::json said = Explain(
      MakeRun("slip",
              "time[s],status,active,lost,left_foot.contact,"
              "left_foot.tilt[rad],left_foot.slide[m]\n"
              "0.1,ok,left_foot.cop.x_max=1,momentum.lx=10,1,0.001,0.001\n"
              "0.2,ok,left_foot.cop.x_max=1,momentum.lx=20,1,0.001,0.006\n"
              "0.3,ok,left_foot.cop.x_max=1,momentum.lx=20,1,0.001,0.031\n",
              Described(R"({"recovered": false, "fell_at": 0.3,
                            "fell_by": "a foot slid over 30 mm"})")));
  const std::vector<std::string> story = said["story"];
  ASSERT_EQ(story.size(), 4u);
  EXPECT_EQ(story[1],
            "0.200 s: the left foot slips on the ground: it has slid by more "
            "than 5 mm.");
  EXPECT_EQ(story[3],
            "Rougher ground, or a lower friction coefficient in the "
            "controller, may have helped.");
}

TEST(Explanation, ReportsMostViolatedLimitAndFailedLevel) {
  const nlohmann::json said =
      Explain(MakeRun("gave_way",
                      "time[s],status,active,reason\n0,limit_relaxed,,"
                      "torque.l_knee.max\n0.1,truncated,,rank_5\n",
                      Described()));
  EXPECT_EQ(said["status"][0]["reason"], "torque.l_knee.max");
  EXPECT_EQ(said["sentences"][0],
            "0.000 s: the controller reports limit relaxed until 0.000 s: the "
            "most violated limit is the torque of l knee at its upper limit.");
  EXPECT_EQ(said["sentences"][1],
            "0.100 s: the controller reports truncated until 0.100 s: level 5 "
            "and the levels below it are not solved.");
}

// A status with pauses has fewer ticks than its interval.
TEST(Explanation, CountsTheTicksOfAStatus) {
  const nlohmann::json said =
      Explain(MakeRun("pauses",
                      "time[s],status,active,reason\n0,truncated,,rank_4\n"
                      "0.001,ok,,\n0.002,truncated,,rank_4\n0.003,ok,,\n",
                      Described()));
  EXPECT_EQ(said["status"][0]["ticks"], 2);
  EXPECT_EQ(said["sentences"][0],
            "0.000 s: the controller reports truncated in 2 of 3 ticks until "
            "0.002 s: level 4 and the levels below it are not solved.");
}

// JSON allows only UTF-8. The message names the line.
TEST(Explanation, RejectsInvalidUtf8) {
  const auto refusal = [](const std::string& name, const std::string& rows) {
    const auto run = MakeRun(name, "time[s],status,active\n" + rows,
                             R"({"recovered": null})");
    try {
      Explain(run);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what())
          .substr((run / "log.csv").string().size());
    }
    return std::string();
  };
  EXPECT_EQ(refusal("no_text", "0,ok,\n0.1,ok,torque.l_\xffpaule.max=1\n"),
            ":3: active is 'torque.l_?paule.max=1', is not UTF-8");
  EXPECT_EQ(refusal("no_row", "0,ok\n"),
            ":2: has 2 cells, must have 3 as in the header");
}

}  // namespace
}  // namespace poise
