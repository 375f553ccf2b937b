// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/parity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
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

  // 2 kg of 3 kg are shifted by 0.3 m. About the base's origin, the robot's
  // largest moment of inertia is 0.25 + 0.25 + 2 0.1² = 0.52 kg m².
  const Parity shifted = CompareWithBullet(robot, With("0.1 0 0", "0.4 0 0"));
  EXPECT_LT(shifted.mass, 1e-12);
  EXPECT_NEAR(shifted.center_of_mass, 0.2 / std::sqrt(0.52 / 3), 1e-9);

  const Parity wide =
      CompareWithBullet(robot, With("iyy=\"0.2\" iyz=\"0\" izz=\"0.25\"",
                                    "iyy=\"0.22\" iyz=\"0\" izz=\"0.25\""));
  EXPECT_LT(wide.mass, 1e-12);
  EXPECT_LT(wide.center_of_mass, 1e-12);
  EXPECT_GT(wide.inertia, 0.01);
  EXPECT_LT(wide.inertia, 0.1);
}

// The links are 5 mm long. Rounding does not grow as the robot shrinks.
TEST(CompareWithBullet, IsAsExactForSmallRobots) {
  const auto scaled = [](double scale) {
    std::ostringstream text;
    text.precision(17);
    const double m = std::pow(scale, 3);
    const double I = 0.1 * m * scale * scale;
    const auto link = [&](const char* name, double x) {
      text << "<link name='" << name << "'><inertial><origin xyz='" << x * scale
           << " 0 0'/><mass value='" << m << "'/><inertia ixx='" << I
           << "' ixy='0' ixz='0' iyy='" << I << "' iyz='0' izz='" << I
           << "'/></inertial></link>";
    };
    text << "<robot name='r'>";
    link("0", 0.1);
    for (int i = 1; i < 6; ++i) {
      link(std::to_string(i).c_str(), 0.3);
      text << "<joint name='j" << i << "' type='revolute'><origin xyz='"
           << 0.5 * scale << " 0 0' rpy='0.3 0 0.2'/><parent link='" << i - 1
           << "'/><child link='" << i << "'/><axis xyz='0 0 1'/><limit "
           << "lower='-1' upper='1' effort='1' velocity='1'/></joint>";
    }
    text << "</robot>";
    const Robot robot{ParseUrdf(text.str(), "test.urdf"), {}, {}, false};
    return CompareWithBullet(robot, robot).worst();
  };
  // Both are rounding errors, which differ by a small factor only.
  EXPECT_LT(scaled(0.01), 10 * scaled(1));
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
