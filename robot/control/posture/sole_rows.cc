// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/posture/sole_rows.h"

#include "poise/math/so3.h"

namespace poise {

using Eigen::Vector3d;

SoleState StateOf(const Foot& foot, const Tick& tick, int i,
                  const std::vector<int>& columns) {
  const FrameTick& F = tick.frames[i];
  const Pose X_WC = tick.X_WB[foot.body] * foot.X_BC;
  SoleState state{X_WC, F.J_WF_W(Eigen::all, columns)};
  state.J_WC_W.bottomRows<3>() -=
      Hat(X_WC.p - F.X_WF.p) * F.J_WF_W.topRows<3>()(Eigen::all, columns);
  return state;
}

void AddSoleRows(const SoleState (&soles)[2], Hierarchy* hierarchy) {
  for (const SoleState& foot : soles) {
    EqualityBlock rows = hierarchy->AddEqualities(1, 5);
    rows.B.topRows<3>() = foot.J_WC_W.topRows<3>();
    rows.b.head<3>() = LogSo3(foot.X_WC.R);
    rows.B.row(3) = foot.J_WC_W.row(3);
    rows.b[3] = foot.X_WC.p.x();
    rows.B.row(4) = foot.J_WC_W.row(5);
    rows.b[4] = foot.X_WC.p.z();
  }
  EqualityBlock middle = hierarchy->AddEqualities(1, 1);
  middle.B.row(0) = soles[0].J_WC_W.row(4) + soles[1].J_WC_W.row(4);
  middle.b[0] = soles[0].X_WC.p.y() + soles[1].X_WC.p.y();
}

void AddMeanSoleRows(const SoleState (&soles)[2], double apart,
                     Hierarchy* hierarchy) {
  const Vector3d turn[2] = {LogSo3(soles[0].X_WC.R), LogSo3(soles[1].X_WC.R)};
  for (const int i : {0, 1}) {
    EqualityBlock rows = hierarchy->AddEqualities(1, 3);
    rows.B.topRows<2>() = soles[i].J_WC_W.topRows<2>();
    rows.b.head<2>() = turn[i].head<2>();
    rows.B.row(2) = soles[i].J_WC_W.row(5);
    rows.b[2] = soles[i].X_WC.p.z();
  }
  EqualityBlock mean = hierarchy->AddEqualities(1, 3);
  mean.B = soles[0].J_WC_W.middleRows<3>(2) + soles[1].J_WC_W.middleRows<3>(2);
  mean.b << turn[0].z() + turn[1].z(),
      (soles[0].X_WC.p + soles[1].X_WC.p).head<2>();
  // The legs do not cross.
  InequalityBlock width = hierarchy->AddInequalities(1, 1);
  width.C.row(0) = soles[0].J_WC_W.row(4) - soles[1].J_WC_W.row(4);
  width.lower[0] = apart - (soles[0].X_WC.p - soles[1].X_WC.p).y();
  EqualityBlock differences = hierarchy->AddEqualities(3, 2);
  differences.B =
      soles[0].J_WC_W.middleRows<2>(2) - soles[1].J_WC_W.middleRows<2>(2);
  differences.b << turn[0].z() - turn[1].z(),
      (soles[0].X_WC.p - soles[1].X_WC.p).x();
}

void AddSupportRows(const SoleState (&soles)[2], const Pose (&X_WC_wanted)[2],
                    int stance, bool keeps_other, Hierarchy* hierarchy) {
  for (const int i : {stance, 1 - stance}) {
    const SoleState& foot = soles[i];
    EqualityBlock height = hierarchy->AddEqualities(1, 1);
    height.B.row(0) = foot.J_WC_W.row(5);
    height.b[0] = foot.X_WC.p.z() - X_WC_wanted[i].p.z();
    EqualityBlock rows =
        hierarchy->AddEqualities(i == stance || keeps_other ? 1 : 3, 5);
    rows.B = foot.J_WC_W.topRows<5>();
    rows.b << LogSo3(foot.X_WC.R * X_WC_wanted[i].R.transpose()),
        (foot.X_WC.p - X_WC_wanted[i].p).head<2>();
  }
}

}  // namespace poise
