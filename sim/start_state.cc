// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/start_state.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "poise/sim/sensors.h"

namespace poise {

State MakeStartState(const Robot& robot, const StartSettings& start,
                     const Ground& ground, unsigned seed) {
  const Tree& tree = robot.model.tree;
  State state{0, robot.q_nominal, Eigen::VectorXd::Zero(tree.nv())};

  std::vector<bool> is_leg(tree.num_bodies(), false);
  for (const Foot& foot : robot.feet) {
    for (int i = foot.body; i != 0; i = tree.joints()[i - 1].parent) {
      is_leg[i] = true;
    }
  }
  RandomStream random(seed);
  for (int j = 0; j < tree.num_joints(); ++j) {
    // A joint of a leg draws a number, too. So the offsets of the other joints
    // do not depend on which links are legs.
    const double offset = start.joints * (2 * random.Uniform() - 1);
    if (is_leg[j + 1]) continue;
    double& q = state.q[tree.q_start() + j];
    q = std::clamp(q + offset, std::min(q, robot.model.limits[j].lower),
                   std::max(q, robot.model.limits[j].upper));
  }

  const Eigen::Quaterniond R_WG = GroundRotation(ground);
  const Eigen::Quaterniond R_WS =
      R_WG * Eigen::AngleAxisd(start.heading, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d place_G(start.place.x(), start.place.y(), start.drop);
  state.q.head<3>() = R_WS * state.q.head<3>() + R_WG * place_G;
  state.q.segment<4>(3) =
      (R_WS * Eigen::Quaterniond(state.q.segment<4>(3))).coeffs();
  return state;
}

}  // namespace poise
