// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push_map/push_map_files.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace poise {
namespace {

namespace fs = std::filesystem;

constexpr char kHeader[] =
    "direction_deg,duration_s,tasks,impulse_Ns,lipm_Ns,lipm_height_Ns,eta\n";

fs::path NewFolder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / name;
  fs::remove_all(folder);
  return folder;
}

std::string Read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

TEST(PushMapFiles, WritesResultsInOrderOfPoints) {
  const fs::path folder = NewFolder("map_order");
  PushMapFiles files(folder, "seed 1", true);
  EXPECT_EQ(Read(folder / "map.csv"), kHeader);
  files.AddFound({90, 0.1, "default"}, {20, 25, 16});
  files.AddFound({22.5, 0.1, "default"}, {16, 20, 12.5});
  EXPECT_EQ(Read(folder / "map.csv"), std::string(kHeader) +
                                          "22.5,0.1,default,16,20,12.5,0.8\n"
                                          "90,0.1,default,20,25,16,0.8\n");
}

TEST(PushMapFiles, ContinueAnInterruptedMap) {
  const fs::path folder = NewFolder("map_again");
  const PushMapPoint point{90, 0.1, "-cop-yaw+yaw_constant"};
  {
    PushMapFiles files(folder, "seed 1", true);
    files.AddTried(point, 12.25, {true, 2});
    files.AddTried(point, 12.5, {false, 0});
    files.AddFound({0, 0.1, "default"}, {16, 20, 12.5});
  }
  // The map was interrupted in the middle of a line.
  std::ofstream(folder / "trials.csv", std::ios::app) << "90,0.1,-cop-yaw+ya";
  const PushMapFiles files(folder, "seed 1", true);
  EXPECT_TRUE(files.Tried(point, 12.25)->recovered);
  EXPECT_EQ(files.Tried(point, 12.25)->steps, 2);
  EXPECT_FALSE(files.Tried(point, 12.5)->recovered);
  EXPECT_FALSE(files.Tried(point, 12.75));
  EXPECT_FALSE(files.Tried({90, 0.2, point.tasks}, 12.5));
  EXPECT_EQ(files.Found({0, 0.1, "default"})->impulse, 16);
  EXPECT_EQ(files.Found({0, 0.1, "default"})->lipm, 20);
  EXPECT_EQ(files.Found({0, 0.1, "default"})->lipm_height, 12.5);
  EXPECT_FALSE(files.Found(point));
  EXPECT_EQ(Read(folder / "trials.csv").find("+ya\n"), std::string::npos);
}

TEST(PushMapFiles, KeepTheColumnsOfAMapWithSteps) {
  const fs::path folder = NewFolder("map_steps");
  const PushMapPoint point{90, 0.1, "default"};
  {
    PushMapFiles files(folder, "seed 1", true, true);
    PushMapValue value{30, 25, 16, {}};
    value.steps = PushMapValue::Steps{2, 40, {31.5, 33}, 22.5};
    files.AddFound(point, value);
    value.steps = PushMapValue::Steps{0, 50, {}, 0};
    files.AddFound({0, 0.1, "default"}, value);
  }
  std::string header = kHeader;
  header.pop_back();
  const std::string text =
      header + ",steps,step_Ns,eta_step,holes,first_step_Ns\n" +
      "0,0.1,default,30,25,16,1.2,0,50,0.6,,0\n" +
      "90,0.1,default,30,25,16,1.2,2,40,0.75,31.5;33,22.5\n";
  EXPECT_EQ(Read(folder / "map.csv"), text);
  const PushMapFiles again(folder, "seed 1", true, true);
  EXPECT_EQ(Read(folder / "map.csv"), text);
  EXPECT_EQ(again.Found(point)->steps->holes, (std::vector<double>{31.5, 33}));
  EXPECT_EQ(again.Found(point)->steps->count, 2);
}

TEST(PushMapFiles, OfShardsMergeByConcatenation) {
  const fs::path a = NewFolder("shard_1"), b = NewFolder("shard_2"),
                 all = NewFolder("shard_all");
  PushMapFiles(a, "s", true).AddFound({0, 0.1, "default"}, {16, 20, 10});
  PushMapFiles(b, "s", false).AddFound({90, 0.1, "default"}, {20, 25, 20});
  const std::string joined = Read(a / "map.csv") + Read(b / "map.csv");
  EXPECT_EQ(joined, std::string(kHeader) +
                        "0,0.1,default,16,20,10,0.8\n"
                        "90,0.1,default,20,25,20,0.8\n");
  fs::create_directories(all);
  std::ofstream(all / "map.csv") << joined;
  EXPECT_EQ(PushMapFiles(all, "s", true).found().size(), 2u);
}

TEST(PushMapFiles, RejectMapWithOtherSettings) {
  const fs::path folder = NewFolder("map_other");
  { PushMapFiles(folder, "seed 1", true); }
  EXPECT_NO_THROW(PushMapFiles(folder, "seed 1", true));
  EXPECT_THROW(PushMapFiles(folder, "seed 2", true), std::invalid_argument);
}

TEST(PushMapFiles, RejectInvalidMap) {
  const fs::path folder = NewFolder("map_broken");
  fs::create_directories(folder);
  std::ofstream(folder / "map.csv") << "0,0.1,default,16\n";
  EXPECT_THROW(PushMapFiles(folder, "s", true), std::invalid_argument);
  std::ofstream(folder / "map.csv") << "0,0.1,default,16x,20,10,0.8\n";
  EXPECT_THROW(PushMapFiles(folder, "s", true), std::invalid_argument);
}

TEST(TaskSetName, JoinsTheChanges) {
  EXPECT_EQ(TaskSetName({}, {}), "default");
  EXPECT_EQ(TaskSetName({"yaw_constant"}, {"cop", "yaw"}),
            "-cop-yaw+yaw_constant");
}

}  // namespace
}  // namespace poise
