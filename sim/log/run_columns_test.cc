// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/run_columns.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "poise/sim/log/columns.h"

namespace poise {
namespace {

std::filesystem::path Written(const std::string& text) {
  const auto file = std::filesystem::path(testing::TempDir()) / "columns.csv";
  std::ofstream(file) << text;
  return file;
}

TEST(RunColumns, ReadsTheColumnsAskedFor) {
  const RunColumns columns(
      Written("time[s],a[m],b,status\n0,1,2,ok\n0.5,3,4,ok\n1,5,6,ok\n"),
      {"b", "a"});
  EXPECT_EQ(columns["a"], (std::vector<double>{1, 3, 5}));
  EXPECT_EQ(columns["b"], (std::vector<double>{2, 4, 6}));
  EXPECT_EQ(columns[kTimeColumn], (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(columns.RowAt(-1), 0);
  EXPECT_EQ(columns.RowAt(0.1), 1);
  EXPECT_EQ(columns.RowAt(0.5), 1);
  EXPECT_EQ(columns.RowAt(7), 2);
}

TEST(RunColumns, RejectsAMissingColumnAndAnEmptyLog) {
  EXPECT_THROW(RunColumns(Written("time[s],a\n0,1\n"), {"b"}),
               std::invalid_argument);
  EXPECT_THROW(RunColumns(Written("a\n0\n"), {"a"}), std::invalid_argument);
  EXPECT_THROW(RunColumns(Written("time[s],a\n"), {"a"}),
               std::invalid_argument);
}

TEST(RunColumns, GivesAConfiguration) {
  JointSpec knee;
  knee.name = "knee";
  knee.type = JointType::kRevolute;
  knee.parent = "thigh";
  knee.child = "shank";
  const RobotModel robot{
      "leg",
      TreeBuilder().AddLink("thigh").AddLink("shank").AddJoint(knee).Build(),
      {},
      {},
      {},
      {},
      0};
  const RunColumns columns(
      Written("time[s],q.knee[rad],base.x[m],base.y[m],base.z[m],base.qx,"
              "base.qy,base.qz,base.qw\n0,0.7,1,2,3,0.1,0.2,0.3,0.9\n"),
      ConfigurationColumns(robot));
  Eigen::VectorXd expected(8);
  expected << 1, 2, 3, 0.1, 0.2, 0.3, 0.9, 0.7;
  EXPECT_EQ(ConfigurationAt(robot, columns, 0), expected);
}

}  // namespace
}  // namespace poise
