// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Robots whose motors hold a standing posture, but that fall.
#include <gtest/gtest.h>

#include <string>

#include "poise/tests/util/test_file.h"
#include "poise/tools/commands/doctor/biped_fixture.h"
#include "poise/tools/commands/doctor/diagnose.h"
#include "poise/tools/commands/doctor/write_diagnosis.h"

namespace poise {
namespace {

// Longer than the slowest build needs for a simulation, s.
constexpr double kEnough = 600;

// The tail is a ball behind the robot. The standing posture does not consider
// it.
Diagnosis ExamineWithTail(const std::string& z) {
  std::string text = TextOf({});
  text.insert(text.find("</robot>"),
              "<link name='tail'><collision><geometry><sphere radius='0.03'/>"
              "</geometry></collision></link><joint name='tail' type='fixed'>"
              "<origin xyz='-0.3 0 " +
                  z + "'/><parent link='trunk'/><child link='tail'/></joint>");
  return Diagnose(TestFile("robot.urdf", text), {}, {}, kEnough);
}

TEST(SimulatedFall, IsFoundIfTheTailIsInTheFloor) {
  EXPECT_TRUE(ExamineWithTail("-0.4").stands);
  const Diagnosis diagnosis = ExamineWithTail("-0.8");
  EXPECT_FALSE(diagnosis.stands);
  EXPECT_TRUE(diagnosis.was_tested);
  EXPECT_EQ(VerdictWord(diagnosis), "warn");
  EXPECT_EQ(diagnosis.reason.find("it falls after "), 0u) << diagnosis.reason;
}

}  // namespace
}  // namespace poise
