// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/parity.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/dynamics/tick.h"
#include "poise/robot/limits.h"
#include "poise/sim/plants/bullet/bullet_plant.h"
#include "poise/sim/plants/plant_settings.h"

namespace poise {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Returns the accelerations of the plant, at rest, under a generalized force.
VectorXd Accelerations(const VectorXd& q, const VectorXd& force,
                       BulletPlant* plant) {
  const int n = static_cast<int>(force.size()) - 6;
  plant->Reset(q, VectorXd::Zero(n + 6));
  plant->Apply({0, Vector3d::Zero(), force.head<3>(), force.segment<3>(3)});
  plant->Step(force.tail(n));
  return plant->Sense().vdot;
}

// Returns the robot's largest radius of gyration about the base's origin, m.
double RadiusOfGyration(const Tick& tick) {
  return std::sqrt(tick.M.diagonal().head<3>().maxCoeff() / tick.M(3, 3));
}

// Returns the accelerations that have the magnitude of gravity at the robot's
// radius of gyration, in m/s² or rad/s².
VectorXd Magnitudes(const Tree& tree, const Tick& tick) {
  const double gravity = tree.gravity_W().norm();
  const double radius = RadiusOfGyration(tick);
  VectorXd size = VectorXd::Constant(tree.nv(), gravity / radius);
  size.segment<3>(3).setConstant(gravity);
  for (int j = 0; j < tree.num_joints(); ++j) {
    if (tree.joints()[j].type != JointType::kPrismatic) continue;
    size[tree.v_start() + j] = gravity;
  }
  return size;
}

// Returns the center of mass relative to the base's origin, in world axes, from
// the off-diagonal entries of M.
Vector3d CenterOfMass(const MatrixXd& M) {
  const double mass = M(3, 3);
  return Vector3d(M(2, 4), M(0, 5), M(1, 3)) / mass;
}

}  // namespace

double Parity::worst() const {
  return Eigen::Vector4d(mass, center_of_mass, inertia, gravity)
      .maxCoeff<Eigen::PropagateNaN>();
}

Parity CompareWithBullet(const Robot& robot, const Robot& plant_of) {
  // Without feet and collision shapes the robot touches nothing. Without effort
  // limits no force is clamped.
  Robot free = plant_of;
  free.feet.clear();
  free.model.collisions.clear();
  const Tree& tree = robot.model.tree;
  const VectorXd q = RestConfiguration(robot.model);
  for (JointLimits& limits : free.model.limits) {
    limits.effort = std::numeric_limits<double>::infinity();
  }
  PlantSettings settings;
  settings.joint_limits = false;
  settings.joint_damping = false;
  settings.self_collision = false;
  BulletPlant plant(free, settings);
  const int nv = tree.nv();
  const VectorXd fall = Accelerations(q, VectorXd::Zero(nv), &plant);
  MatrixXd answers(nv, nv);
  Tick tick(tree, {});
  ComputeTick(tree, q, VectorXd::Zero(nv), &tick);
  // Forces are proportional to the inertia that they move. So all accelerations
  // have the magnitude of gravity, at robots of any size, and none is lost in
  // rounding.
  const VectorXd diagonal = tick.M.diagonal();
  const VectorXd unit = diagonal.cwiseProduct(Magnitudes(tree, tick));
  for (int i = 0; i < nv; ++i) {
    answers.col(i) =
        Accelerations(q, unit[i] * VectorXd::Unit(nv, i), &plant) - fall;
  }
  // answers = M'^-1 diag(unit).
  const MatrixXd M = unit.asDiagonal() * answers.partialPivLu().inverse();

  const double mass = tick.M(3, 3);
  const Vector3d p_G = CenterOfMass(tick.M);
  Parity parity{};
  parity.mass = std::abs(M(3, 3) - mass) / mass;
  parity.center_of_mass =
      (CenterOfMass(M) - p_G).norm() / RadiusOfGyration(tick);
  const VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
  parity.inertia = (scale.asDiagonal() * (M - tick.M) * scale.asDiagonal())
                       .cwiseAbs()
                       .maxCoeff<Eigen::PropagateNaN>();
  const VectorXd gravity = -M * fall;
  parity.gravity =
      (gravity - tick.N).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() /
      tick.N.lpNorm<Eigen::Infinity>();
  return parity;
}

}  // namespace poise
