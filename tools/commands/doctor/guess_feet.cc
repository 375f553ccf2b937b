// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/guess_feet.h"

#include <algorithm>
#include <utility>

#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"
#include "poise/robot/feet/leg_names.h"
#include "poise/robot/feet/legs.h"

namespace poise {
namespace {

// Returns whether the links and joints from the root to a body have more names
// of parts of an arm than of a leg.
bool IsArm(const RobotModel& model, int body) {
  int words = 0;
  for (int b = body; b > 0; b = model.tree.joints()[b - 1].parent) {
    words += LegOrArm(LinkOf(model, b));
    words += LegOrArm(model.tree.joints()[b - 1].name);
  }
  return words < 0;
}

}  // namespace

std::vector<Diagnosis::Sole> GuessFeet(const RobotModel& model) {
  const Tree& tree = model.tree;
  const std::vector<Pose> X_WB = RestPoses(model);
  std::vector<bool> has_child(tree.num_bodies());
  for (const Joint& joint : tree.joints()) has_child[joint.parent] = true;
  std::vector<int> ends;
  for (int b = 1; b < tree.num_bodies(); ++b) {
    if (!has_child[b] && !IsArm(model, b)) ends.push_back(b);
  }
  if (ends.size() < 2) return {};
  std::stable_sort(ends.begin(), ends.end(),
                   [&](int a, int b) { return X_WB[a].p.z() < X_WB[b].p.z(); });
  // REP 103: y points to the left.
  if (X_WB[ends[0]].p.y() < X_WB[ends[1]].p.y()) std::swap(ends[0], ends[1]);
  std::vector<Diagnosis::Sole> feet;
  for (const int i : {0, 1}) {
    const double leg = -X_WB[ends[i]].p.z();
    if (!(leg > 0)) return {};
    feet.push_back({i == 0 ? "left_foot" : "right_foot",
                    LinkOf(model, ends[i]),
                    0.22 * leg,
                    0.085 * leg,
                    {0.04 * leg, 0, -0.1 * leg},
                    {0, 0, 0},
                    "guess",
                    0.1 * leg});
  }
  return feet;
}

}  // namespace poise
