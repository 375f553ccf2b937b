// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/columns.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace poise {
namespace {

using Kind = LogColumn::Kind;

// Users' scripts read these names: docs/log.md.
TEST(Columns, AreTheDocumentedColumns) {
  std::string header;
  for (const LogColumn& column : LogColumns(
           {"left_foot", "paw"}, {"hip", "knee"}, {"com", "posture"}, 2)) {
    header += column.name + '\n';
  }
  EXPECT_EQ(header,
            "time[s]\nbase.x[m]\nbase.y[m]\nbase.z[m]\nbase.qx\nbase.qy\n"
            "base.qz\nbase.qw\nbase.tilt[rad]\ncom.x[m]\ncom.y[m]\ncom.z[m]\n"
            "com_ref.x[m]\ncom_ref.y[m]\ncom_ref.z[m]\ncop.x[m]\ncop.y[m]\n"
            "left_foot.contact\nleft_foot.tilt[rad]\nleft_foot.slide[m]\n"
            "left_foot.mx[Nm]\nleft_foot.my[Nm]\nleft_foot.mz[Nm]\n"
            "left_foot.fx[N]\nleft_foot.fy[N]\nleft_foot.fz[N]\n"
            "paw.contact\npaw.tilt[rad]\npaw.slide[m]\npaw.mx[Nm]\n"
            "paw.my[Nm]\npaw.mz[Nm]\npaw.fx[N]\npaw.fy[N]\npaw.fz[N]\n"
            "push.fx[N]\npush.fy[N]\npush.fz[N]\nother.fx[N]\nother.fy[N]\n"
            "other.fz[N]\nself_contacts\ntau.hip[Nm]\ntau.knee[Nm]\n"
            "q.hip[rad]\nq.knee[rad]\nlambda.left_foot.mx[Nm]\n"
            "lambda.left_foot.my[Nm]\nlambda.left_foot.mz[Nm]\n"
            "lambda.left_foot.fx[N]\nlambda.left_foot.fy[N]\n"
            "lambda.left_foot.fz[N]\nlambda.paw.mx[Nm]\nlambda.paw.my[Nm]\n"
            "lambda.paw.mz[Nm]\nlambda.paw.fx[N]\nlambda.paw.fy[N]\n"
            "lambda.paw.fz[N]\nresidual.com\nresidual.posture\n"
            "com_vel.x[m/s]\ncom_vel.y[m/s]\ncom_vel.z[m/s]\nxi.x[m]\n"
            "xi.y[m]\nleft_foot.x[m]\nleft_foot.y[m]\nleft_foot.z[m]\n"
            "paw.x[m]\npaw.y[m]\npaw.z[m]\nplan.x[m]\nplan.y[m]\n"
            "plan.time[s]\nplan.beyond[m]\ngap.level_1\ngap.level_2\ntouching\n"
            "status\nactive\nlost\nconflict\nleft_foot.phase\npaw.phase\n"
            "reason\n");
}

TEST(Columns, HaveAKnownGroupThatAgreesWithTheirKind) {
  std::map<ColumnGroup, int> count;
  for (const LogColumn& column : LogColumns(
           {"left_foot", "paw"}, {"hip", "knee"}, {"com", "contact"}, 2)) {
    SCOPED_TRACE(column.name);
    const ColumnGroup group = GroupOf(column.name);
    EXPECT_NE(group, ColumnGroup::kUnknown);
    EXPECT_EQ(group == ColumnGroup::kText, column.kind == Kind::kText);
    EXPECT_EQ(group == ColumnGroup::kTime, column.kind == Kind::kTime);
    ++count[group];
  }
  EXPECT_EQ(count[ColumnGroup::kBasePose], 7);
  EXPECT_EQ(count[ColumnGroup::kCom], 3);
  EXPECT_EQ(count[ColumnGroup::kContact], 2);
  EXPECT_EQ(count[ColumnGroup::kTiltOrSlide], 4);
  EXPECT_EQ(count[ColumnGroup::kMoment], 6);
  EXPECT_EQ(count[ColumnGroup::kForce], 6);
  EXPECT_EQ(count[ColumnGroup::kCommandedWrench], 12);
  EXPECT_EQ(count[ColumnGroup::kTorque], 2);
  EXPECT_EQ(count[ColumnGroup::kPosition], 2);
  EXPECT_EQ(count[ColumnGroup::kResidual], 2);
  EXPECT_EQ(count[ColumnGroup::kGap], 2);
  EXPECT_EQ(count[ColumnGroup::kComVelocity], 3);
  EXPECT_EQ(count[ColumnGroup::kXi], 2);
  EXPECT_EQ(count[ColumnGroup::kFootPosition], 6);
  EXPECT_EQ(count[ColumnGroup::kPlan], 4);
  EXPECT_EQ(count[ColumnGroup::kText], 8);
}

TEST(Columns, HaveNoGroupForAnUnknownName) {
  for (const char* name : {"", "a", "paw.fw", ".fx", "mass[kg]", "paw.f"}) {
    EXPECT_EQ(GroupOf(name), ColumnGroup::kUnknown) << name;
  }
}

TEST(LogName, HasNoSeparators) {
  EXPECT_EQ(LogName("left foot"), "left foot");
  EXPECT_EQ(LogName("a,b;c=d|e\nf\rg"), "a_b_c_d_e_f_g");
}

}  // namespace
}  // namespace poise
