// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Runs the repository's scenarios and collects extreme values over their ticks.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "poise/robot/control/stand.h"
#include "poise/robot/limits.h"
#include "poise/robot/robot.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/judge.h"
#include "poise/sim/observation.h"
#include "poise/sim/scenario.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {

inline const Robot& Humanoid() {
  static const Robot robot = LoadHumanoid();
  return robot;
}

// Returns a scenario of sim/scenarios with another duration, s.
inline Scenario Ours(const std::string& name, double duration) {
  Scenario scenario = LoadScenario("sim/scenarios/" + name + ".yaml");
  scenario.duration = duration;
  return scenario;
}

// Extreme values over the ticks of a run, and its verdict.
struct Story {
  Verdict verdict;
  int failures = 0;  // Ticks that were not solved to the last level.
  // Extremes of the commanded wrenches: distance of a CoP beyond its sole, m,
  // and the largest ratio of tangential to normal force.
  double asked_beyond = -1, asked_friction = 0;
  // Extremes of the wrenches that the ground applied.
  double given_beyond = -1, given_friction = 0;
  double torque_violation = 0, joint_violation = 0;  // N m, rad.
  std::vector<double> com_error;  // In the plane, m, each tick.

  // Returns the largest error in [from, to), times in s.
  double ErrorIn(double from, double to) const {
    double largest = -1;
    for (size_t k = 0; k < com_error.size(); ++k) {
      const double time = 1e-3 * static_cast<double>(k);
      if (time < from || time >= to) continue;
      largest = std::max(largest, com_error[k]);
    }
    return largest;
  }
};

inline void LookAtWrench(const Foot& foot, const Eigen::Matrix<double, 6, 1>& F,
                         double* beyond, double* friction) {
  if (F[5] < 5) return;  // N; a foot with less load has no useful CoP.
  const Eigen::Vector2d cop(-F[1] / F[5], F[0] / F[5]);
  *beyond = std::max(*beyond, (cop.cwiseAbs() - foot.half_size).maxCoeff());
  *friction =
      std::max(*friction, F.segment<2>(3).lpNorm<Eigen::Infinity>() / F[5]);
}

inline Story Tell(const Scenario& scenario,
                  const std::function<void(const ClosedLoop&)>& look = {}) {
  const Robot& robot = Humanoid();
  ClosedLoop loop(robot, scenario);
  Judge judge(StandingHeight(robot));
  Story story;
  const int nv = robot.model.tree.nv();
  const int n = robot.model.tree.num_joints();
  while (loop.time() < scenario.duration - 1e-6 && !judge.is_down()) {
    loop.Tick();
    judge.Look(loop.observation());
    if (look) look(loop);
    const TickRecord record = loop.record();
    story.failures += record.report.status == TickStatus::kTruncated ||
                      record.report.status == TickStatus::kFailSafe;
    for (int i = 0; i < 2; ++i) {
      LookAtWrench(robot.feet[i], record.report.foot_wrench(nv, i),
                   &story.asked_beyond, &story.asked_friction);
      LookAtWrench(robot.feet[i], loop.observation().feet[i].F_Co_C,
                   &story.given_beyond, &story.given_friction);
    }
    for (int j = 0; j < n; ++j) {
      story.torque_violation =
          std::max(story.torque_violation,
                   std::abs(record.tau[j]) - robot.model.limits[j].effort);
    }
    story.joint_violation = std::max(story.joint_violation,
                                     JointViolation(robot.model, record.end.q));
    const Observation& now = loop.observation();
    story.com_error.push_back((now.com - now.com_ref).head<2>().norm());
  }
  story.verdict = judge.Conclude();
  return story;
}

}  // namespace poise
