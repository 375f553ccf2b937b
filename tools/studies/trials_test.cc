// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/studies/trials.h"

#include <gtest/gtest.h>

namespace poise {
namespace {

TEST(ToRow, SaysWhatBecameOfARobotThatStaysUpElsewhere) {
  const Trial trial{"far off", {"--scenario", "stand"}};
  EXPECT_EQ(
      ToRow(trial, {}),
      "| far off | `--scenario stand` | does not come back | 0.0, 0.0, "
      "0.0 | 0.00, 0.00, 0.00 | 0.0000 | 0.000, 0.000 | 0 | 0 | **no** |");
}

TEST(ToRow, PrintsNumbersNoLongerThanTheyAre) {
  const Trial trial{"pushed",
                    {"--force", "167.003287", "--duration", "0.100000",
                     "--freeze", "1.05,0.02", "--robot", "/a/b.urdf"}};
  TrialResult result;
  result.joint_violation = 2.1e-3;
  const std::string row = ToRow(trial, result);
  EXPECT_NE(row.find("`--force 167.003 --duration 0.1 --freeze 1.05,0.02 "
                     "--robot b.urdf`"),
            std::string::npos)
      << row;
  EXPECT_NE(row.find("| 2e-03 |"), std::string::npos) << row;
}

}  // namespace
}  // namespace poise
