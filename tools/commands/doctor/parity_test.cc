// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/parity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "poise/robot/urdf/urdf.h"

namespace poise {
namespace {

const char kUrdf[] = R"(<robot name="r"><link name="a">
<inertial><origin xyz="0.1 0 0"/><mass value="2"/>
<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.25"/></inertial>
</link><link name="b"><inertial><origin xyz="0 0 0.25"/><mass value="1"/>
<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.25"/></inertial>
</link><joint name="j" type="revolute"><parent link="a"/><child link="b"/>
<axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
</joint></robot>)";

Robot With(const std::string& old_text, const std::string& new_text) {
  std::string text = kUrdf;
  text.replace(text.find(old_text), old_text.size(), new_text);
  return {ParseUrdf(text, "test.urdf"), {}, {}, false};
}

// Each expected difference follows from the number that is changed.
TEST(CompareWithBullet, DetectsOtherMassCenterAndInertia) {
  const Robot robot = With("", "");
  EXPECT_LT(CompareWithBullet(robot, robot).worst(), 1e-12);

  const Parity heavy =
      CompareWithBullet(robot, With("value=\"1\"", "value=\"1.3\""));
  EXPECT_NEAR(heavy.mass, 0.1, 1e-9);
  EXPECT_NEAR(heavy.gravity, 0.1, 1e-9);

  // 2 kg of 3 kg are shifted by 0.3 m.
  const Parity shifted = CompareWithBullet(robot, With("0.1 0 0", "0.4 0 0"));
  EXPECT_LT(shifted.mass, 1e-12);
  EXPECT_NEAR(shifted.center_of_mass, 0.2, 1e-9);

  const Parity wide =
      CompareWithBullet(robot, With("iyy=\"0.2\" iyz=\"0\" izz=\"0.25\"",
                                    "iyy=\"0.22\" iyz=\"0\" izz=\"0.25\""));
  EXPECT_LT(wide.mass, 1e-12);
  EXPECT_LT(wide.center_of_mass, 1e-12);
  EXPECT_GT(wide.inertia, 0.01);
  EXPECT_LT(wide.inertia, 0.1);
}

TEST(Parity, WorstIsTheLargestOrNaN) {
  EXPECT_EQ((Parity{1, 2, 3, 4}.worst()), 4);
  EXPECT_EQ((Parity{4, 3, 2, 1}.worst()), 4);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(Parity{nan, 1, 1, 1}.worst()));
  EXPECT_TRUE(std::isnan(Parity{1, 1, nan, 1}.worst()));
  EXPECT_TRUE(std::isnan(Parity{1, 1, 1, nan}.worst()));
}

}  // namespace
}  // namespace poise
