// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/recorder.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "poise/robot/profile/profile.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/log/columns.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

const Robot& Humanoid() {
  static const Robot robot = LoadHumanoid();
  return robot;
}

// Returns a scenario with a push in its first ticks.
Scenario Pushed() {
  Scenario scenario = LoadScenario("sim/scenarios/strong_push.yaml");
  scenario.pushes[0].start = 0;
  return scenario;
}

std::filesystem::path Folder(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

std::string Contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    parts.push_back(part);
  }
  if (!text.empty() && text.back() == separator) parts.emplace_back();
  return parts;
}

// Returns a row of a log.csv by the names of its columns.
std::map<std::string, std::string> RowOf(const std::string& csv, int row) {
  const std::vector<std::string> lines = Split(csv, '\n');
  const auto names = Split(lines[0], ','), cells = Split(lines[row + 1], ',');
  EXPECT_EQ(names.size(), cells.size());
  std::map<std::string, std::string> by_name;
  for (size_t i = 0; i < cells.size(); ++i) by_name[names[i]] = cells[i];
  return by_name;
}

TEST(Recorder, WritesTheTrueStateAndTheControllerOutput) {
  ClosedLoop loop(Humanoid(), Pushed());
  Recorder recorder(Folder("recorded"), Humanoid(), loop.controller().stack());
  for (int k = 0; k < 3; ++k) {
    loop.Tick();
    recorder.Record(loop.record());
  }
  recorder.Flush();
  const std::string csv = Contents(Folder("recorded") / "log.csv");
  EXPECT_EQ(recorder.log_sha256().size(), 64u);
  auto row = RowOf(csv, 2);
  const auto number = [&row](const std::string& name) {
    EXPECT_EQ(row.count(name), 1u) << name;
    return std::stod(row[name]);
  };
  const TickRecord record = loop.record();
  const Observation& now = record.observation;
  // The log has nine digits; numbers are up to 1 kN.
  constexpr double kDigits = 1e-6;
  EXPECT_EQ(row["time[s]"], "0.002");
  EXPECT_NEAR(number("base.z[m]"), record.start.q[2], kDigits);
  EXPECT_NEAR(number("base.qw"), record.start.q[6], kDigits);
  EXPECT_NEAR(number("base.tilt[rad]"), now.base_tilt, kDigits);
  EXPECT_NEAR(number("com.y[m]"), now.com.y(), kDigits);
  EXPECT_NEAR(number("com_ref.z[m]"), now.com_ref.z(), kDigits);
  EXPECT_NEAR(number("cop.x[m]"), now.cop.x(), kDigits);
  EXPECT_EQ(number("push.fy[N]"), 100);
  EXPECT_EQ(number("push.fx[N]"), 0);
  const int nv = Humanoid().model.tree.nv();
  for (int i = 0; i < 2; ++i) {
    const std::string foot = Humanoid().feet[i].name;
    EXPECT_EQ(row[foot + ".contact"], "1");
    EXPECT_NEAR(number(foot + ".slide[m]"), now.feet[i].slide, kDigits);
    EXPECT_NEAR(number(foot + ".mx[Nm]"), now.feet[i].F_Co_C[0], kDigits);
    EXPECT_NEAR(number(foot + ".fz[N]"), now.feet[i].F_Co_C[5], kDigits);
    EXPECT_NEAR(number("lambda." + foot + ".fz[N]"),
                record.report.foot_wrench(nv, i)[5], kDigits);
  }
  const auto& joints = Humanoid().model.tree.joints();
  for (size_t j = 0; j < joints.size(); ++j) {
    EXPECT_NEAR(number("tau." + joints[j].name + "[Nm]"), record.end.tau[j],
                kDigits);
    EXPECT_NEAR(number("q." + joints[j].name + "[rad]"), record.start.q[7 + j],
                kDigits);
  }
  // The default tasks are on levels 1 to 5. The log has nine digits.
  for (int level = 1; level <= 5; ++level) {
    const double gap = record.report.gap[level - 1];
    EXPECT_NEAR(number(GapColumn(level)), gap, 1e-8 * gap) << level;
  }
  EXPECT_EQ(row.count(GapColumn(6)), 0u);
  EXPECT_EQ(row["status"], "ok");
  EXPECT_EQ(row["self_contacts"], "0");
  for (const ActiveRow& active : record.report.active) {
    EXPECT_NE(row["active"].find(record.stack.RowName(active) + "="),
              std::string::npos);
  }
  // timing.csv has one row per tick.
  const auto timing = Split(Contents(Folder("recorded") / "timing.csv"), '\n');
  EXPECT_EQ(timing[0], "tick,us,iterations,modelled_us");
  EXPECT_EQ(timing[3].substr(0, 2), "2,");
  // `record` is that of the last tick. The file has two digits after the point.
  const std::vector<std::string> cells = Split(timing[3], ',');
  ASSERT_EQ(cells.size(), 4u);
  EXPECT_EQ(std::stoi(cells[2]), record.report.iterations);
  EXPECT_GT(record.report.modelled_seconds, 0);
  EXPECT_NEAR(std::stod(cells[3]), 1e6 * record.report.modelled_seconds,
              0.0051);
  EXPECT_EQ(timing.size(), 5u);  // An empty part follows the last line.
}

// These columns explain why the range of the CoP changes or torques jump.
TEST(Recorder, WritesContactPhasesAndFailSafeReasons) {
  Scenario scenario = Pushed();
  scenario.stance = {{StanceEvent::Kind::kLift, 0, "right_foot"}};
  scenario.sensors.freeze_at = 0.005;
  scenario.sensors.freeze_for = 0.02;
  ClosedLoop loop(Humanoid(), scenario);
  Recorder recorder(Folder("phases"), Humanoid(), loop.controller().stack());
  for (int k = 0; k < 30; ++k) {
    loop.Tick();
    recorder.Record(loop.record());
  }
  recorder.Flush();
  const std::string csv = Contents(Folder("phases") / "log.csv");
  auto row = RowOf(csv, 2);
  EXPECT_EQ(row["left_foot.phase"], "down");
  EXPECT_EQ(row["right_foot.phase"], "unloading");
  EXPECT_EQ(row["status"], "ok");
  EXPECT_EQ(row["reason"], "");
  row = RowOf(csv, 20);
  EXPECT_EQ(row["status"], "fail_safe");
  EXPECT_EQ(row["reason"], "clock");
}

// The log has the limit with slack and the level at which the solver stopped.
TEST(Recorder, WritesLimitsAndFailedLevels) {
  ClosedLoop loop(Humanoid(), Pushed());
  Recorder recorder(Folder("reasons"), Humanoid(), loop.controller().stack());
  loop.Tick();
  const TickRecord last = loop.record();
  TickReport report = last.report;
  const auto record = [&] {
    recorder.Record({last.tick, last.observation, last.start, last.end,
                     last.tau, last.push_force_W, last.stack, last.hierarchy,
                     report, last.stance, last.gait, last.nv,
                     last.microseconds});
    recorder.Flush();
  };
  report.status = TickStatus::kLimitRelaxed;
  report.relaxed = {*last.stack.Find("torque_limits"),
                    *Humanoid().model.tree.FindJoint("l_knee"),
                    Side::kUpper,
                    2,
                    0.1,
                    0.1};
  record();
  report.relaxed->task = *last.stack.Find("joint_limits");
  report.relaxed->side = Side::kLower;
  record();
  report.status = TickStatus::kTruncated;
  report.failed_level = 5;
  record();
  const std::string csv = Contents(Folder("reasons") / "log.csv");
  EXPECT_EQ(RowOf(csv, 0)["reason"], "torque.l_knee.max");
  EXPECT_EQ(RowOf(csv, 1)["reason"], "joint.l_knee.min");
  EXPECT_EQ(RowOf(csv, 2)["reason"], "rank_5");
}

// Names in a URDF may contain the separators of lists; the log must replace
// them.
TEST(Recorder, KeepsSeparatorsOutOfNames) {
  std::string urdf = Contents("robot/models/humanoid.urdf");
  const auto rename = [&urdf](const std::string& from, const std::string& to) {
    for (size_t at = 0;
         (at = urdf.find('"' + from + '"', at)) != std::string::npos;) {
      urdf.replace(at + 1, from.size(), to);
    }
  };
  rename("l_knee", "l;kn=ee");
  rename("torso", "tor|so;");
  const auto file = Folder("renamed.urdf");
  std::ofstream(file) << urdf;
  Profile profile = LoadProfile("robot/profiles/humanoid.yaml");
  auto knee = profile.joints.extract("l_knee");
  knee.key() = "l;kn=ee";
  profile.joints.insert(std::move(knee));
  Robot robot = LoadRobot(file, profile);
  robot.model.limits[*robot.model.tree.FindJoint("l;kn=ee")].effort = 1;
  ClosedLoop loop(robot, Pushed());
  Recorder recorder(Folder("renamed"), robot, loop.controller().stack());
  loop.Tick();
  const Tree& tree = robot.model.tree;
  const int torso = tree.frames()[*tree.FindFrame("tor|so;")].body;
  PlantState touching = loop.record().end;
  touching.self_contacts = {{torso, 0}};
  const TickRecord last = loop.record();
  recorder.Record({last.tick, last.observation, last.start, touching, last.tau,
                   last.push_force_W, last.stack, last.hierarchy, last.report,
                   last.stance, last.gait, last.nv, last.microseconds});
  recorder.Flush();
  auto row = RowOf(Contents(Folder("renamed") / "log.csv"), 0);
  EXPECT_NE(row["active"].find("torque.l_kn_ee."), std::string::npos)
      << row["active"];
  EXPECT_EQ(row["touching"], "tor_so_|pelvis");
}

TEST(Recorder, RemovesALogOfTheOtherFormat) {
  ClosedLoop loop(Humanoid(), Pushed());
  const Stack& stack = loop.controller().stack();
  { Recorder(Folder("again"), Humanoid(), stack, LogFormat::kBinary); }
  EXPECT_EQ(Contents(Folder("again") / "log.bin").substr(0, 8), "POISELOG");
  { Recorder(Folder("again"), Humanoid(), stack); }
  EXPECT_FALSE(std::filesystem::exists(Folder("again") / "log.bin"));
  EXPECT_TRUE(std::filesystem::exists(Folder("again") / "log.csv"));
}

std::string ErrorOf(const std::function<void()>& body) {
  try {
    body();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Recorder, KeepsTheOldLogIfAFileCannotBeWritten) {
  ClosedLoop loop(Humanoid(), Pushed());
  const auto folder = Folder("refused");
  std::filesystem::create_directories(folder / "timing.csv");
  std::ofstream(folder / "log.csv") << "old";
  std::ofstream(folder / "log.bin") << "old";
  EXPECT_EQ(
      ErrorOf([&] {
        const Recorder recorder(folder, Humanoid(), loop.controller().stack());
      }),
      (folder / "timing.csv").string() + ": cannot be written: Is a directory");
  EXPECT_EQ(Contents(folder / "log.csv"), "old");
  EXPECT_EQ(Contents(folder / "log.bin"), "old");
}

TEST(Recorder, NamesTheFileOnAFullDisk) {
  ClosedLoop loop(Humanoid(), Pushed());
  const auto folder = Folder("full");
  std::filesystem::create_directories(folder);
  std::filesystem::create_symlink("/dev/full", folder / "timing.csv");
  EXPECT_EQ(ErrorOf([&] {
              const Recorder recorder(folder, Humanoid(),
                                      loop.controller().stack());
            }),
            (folder / "timing.csv").string() +
                ": cannot be written: No space left on device");
}

// Where timing.csv cannot be written, the rows of the log already are.
TEST(Recorder, WritesNoRowTwiceAfterAnError) {
  ClosedLoop loop(Humanoid(), Pushed());
  const auto folder = Folder("pipe");
  std::filesystem::create_directories(folder);
  const std::string pipe = (folder / "timing.csv").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::signal(SIGPIPE, SIG_IGN);
  std::thread reader([&] {
    std::string header;
    std::getline(std::ifstream(pipe), header);
  });
  EXPECT_EQ(ErrorOf([&] {
              Recorder recorder(folder, Humanoid(), loop.controller().stack());
              for (int k = 0; k < 1000; ++k) {
                loop.Tick();
                recorder.Record(loop.record());
              }
            }),
            pipe + ": cannot be written: Broken pipe");
  reader.join();
  std::istringstream log(Contents(folder / "log.csv"));
  std::set<std::string> rows;
  for (std::string row; std::getline(log, row);) {
    EXPECT_TRUE(rows.insert(row).second) << row;
  }
  EXPECT_GT(rows.size(), 1u);
}

// The recorder runs in a child process. SIGKILL leaves it no chance to write
// more.
TEST(Recorder, LeavesAReadableLogWhenItIsKilled) {
  const pid_t child = fork();
  if (child == 0) {
    ClosedLoop loop(Humanoid(), Pushed());
    Recorder recorder(Folder("killed"), Humanoid(), loop.controller().stack());
    for (int k = 0; k < 120; ++k) {
      loop.Tick();
      recorder.Record(loop.record());
    }
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  const std::string csv = Contents(Folder("killed") / "log.csv");
  // At most 49 rows are missing: of 120 rows the log has 100, and the header.
  EXPECT_EQ(csv.back(), '\n');
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 101);
  EXPECT_EQ(RowOf(csv, 99)["time[s]"], "0.099");
}

TEST(Recorder, ThrowsIfItCannotWrite) {
  const ClosedLoop loop(Humanoid(), Pushed());
  std::ofstream(Folder("file")) << "not a folder";
  EXPECT_THROW(Recorder(Folder("file"), Humanoid(), loop.controller().stack()),
               std::invalid_argument);
}

}  // namespace
}  // namespace poise
