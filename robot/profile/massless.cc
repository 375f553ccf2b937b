// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/massless.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "poise/dynamics/kinematics.h"
#include "poise/dynamics/tick.h"
#include "poise/robot/feet/legs.h"
#include "poise/robot/limits.h"

namespace poise {
namespace {

using Eigen::VectorXd;

// Above this number of joints, M is not evaluated.
constexpr int kMostJoints = 500;
// Fraction of a mass or an inertia that counts as zero: a rounding error of M.
constexpr double kZero = 1e-14;
// Fraction of the robot's mass below which a body counts as without mass. The
// cable and finger links of real robots weigh more. Bullet divides by the
// moment of inertia about a joint, and treats less than 2e-16 kg m2 as zero,
// which is a body of 1e-10 of 60 kg within 0.2 mm of the axis.
constexpr double kNoMass = 1e-10;
// Fraction of the robot's extent below which a radius of gyration is zero. Its
// square is kZero.
constexpr double kPoint = 1e-7;
// Smallest eigenvalue per degree of freedom of a regular M, scaled to a unit
// diagonal.
constexpr double kSingular = 1e-13;
// Fraction of the robot's mass that a body without mass receives.
constexpr double kSmallMass = 1e-6;
// Radius of gyration that such a body and a point mass receive, as a fraction
// of the robot's extent.
constexpr double kSmallRadius = 0.01;

// Returns the distance of the farthest joint from the base with all joints at
// zero, m. It is at least 1 mm, for a robot that has all joints at one point.
double Extent(const Tree& tree) {
  constexpr double kLeast = 1e-3;
  std::vector<Pose> X_WB(tree.num_bodies());
  ComputePoses(tree, tree.MakeNeutral(), &X_WB);
  double extent = kLeast;
  for (const Pose& X : X_WB) extent = std::max(extent, X.p.norm());
  return extent;
}

// Returns q with each joint moved, each by another angle.
VectorXd Moved(const Tree& tree, VectorXd q) {
  for (int j = 0; j < tree.num_joints(); ++j) {
    q[tree.q_start() + j] += std::sin(1 + 2.3 * j);
  }
  return q;
}

// Returns the larger diagonal of M at rest and in another configuration.
VectorXd LargerDiagonal(const Tree& tree, const VectorXd& q) {
  const VectorXd zero = VectorXd::Zero(tree.nv());
  Tick tick(tree, {});
  ComputeTick(tree, q, zero, &tick);
  const VectorXd diagonal = tick.M.diagonal().cwiseAbs();
  ComputeTick(tree, Moved(tree, q), zero, &tick);
  return diagonal.cwiseMax(tick.M.diagonal().cwiseAbs());
}

// Returns M at rest.
Eigen::MatrixXd MassMatrix(const RobotModel& model) {
  const Tree& tree = model.tree;
  Tick tick(tree, {});
  ComputeTick(tree, RestConfiguration(model), VectorXd::Zero(tree.nv()), &tick);
  return tick.M;
}

// Returns whether M can be inverted at rest.
bool IsRegular(const RobotModel& model) {
  const Tree& tree = model.tree;
  const Eigen::MatrixXd M = MassMatrix(model);
  const VectorXd diagonal = M.diagonal();
  if (!M.allFinite() || !(diagonal.minCoeff() > 0)) return false;
  const VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      scale.asDiagonal() * M * scale.asDiagonal(), Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()[0] > kSingular * tree.nv();
}

// Returns whether a body of a robot of some extent, m, is a point mass.
bool IsPoint(const Inertia& M, double extent) {
  return M.I_G_B.cwiseAbs().maxCoeff() <=
         M.mass * kPoint * kPoint * extent * extent;
}

// Returns an inertia of a mass and a radius of gyration about the origin of the
// link's frame.
Inertia Ball(double mass, double gyrating_mass, double radius) {
  return {mass, Eigen::Vector3d::Zero(),
          gyrating_mass * radius * radius * Eigen::Matrix3d::Identity()};
}

// Returns, by joint, whether the joints before it in the tree can undo every
// motion of the masses that it causes at rest: the Schur complement of M is
// then 0 there. Joints in `none` do not count.
std::vector<bool> FindDependent(const RobotModel& model,
                                const std::vector<bool>& none) {
  const Tree& tree = model.tree;
  Eigen::MatrixXd S = MassMatrix(model);
  const VectorXd diagonal = S.diagonal();
  std::vector<bool> dependent(tree.num_joints());
  for (int i = 0; i < tree.nv(); ++i) {
    const int j = i - tree.v_start();
    if (j >= 0 && none[j]) continue;
    if (!(S(i, i) > kSingular * tree.nv() * diagonal[i])) {
      if (j >= 0) dependent[j] = true;
      continue;
    }
    const int rest = tree.nv() - i - 1;
    const VectorXd column = S.col(i).tail(rest);
    S.bottomRightCorner(rest, rest) -= column * column.transpose() / S(i, i);
  }
  return dependent;
}

}  // namespace

MovedMass FindMovedMass(const RobotModel& model) {
  const Tree& tree = model.tree;
  const int n = tree.num_joints();
  VectorXd mass(n + 1);  // Mass of each body and all bodies beyond.
  for (int b = n; b >= 0; --b) mass[b] = tree.inertias()[b].mass;
  for (int b = n; b > 0; --b) mass[tree.joints()[b - 1].parent] += mass[b];
  const double extent = Extent(tree);
  const VectorXd small = kZero * mass.tail(n) * extent * extent;
  VectorXd diagonal = small;
  if (n <= kMostJoints) {
    diagonal = LargerDiagonal(tree, RestConfiguration(model)).tail(n);
  }

  MovedMass moved{std::vector<bool>(n), std::vector<double>(n)};
  for (int j = 0; j < n; ++j) {
    const int b = j + 1;
    moved.fraction[j] = mass[b] / mass[0];
    const double nothing = kNoMass * mass[0];
    const bool nothing_beyond = mass[b] <= nothing;
    // With its mass on one side only, a robot has the base's six coordinates
    // and the joint's for one body.
    const bool nothing_before = mass[0] - mass[b] <= nothing;
    moved.none[j] = nothing_beyond || nothing_before || diagonal[j] < small[j];
  }
  if (n > kMostJoints) return moved;
  const std::vector<bool> dependent = FindDependent(model, moved.none);
  for (int j = 0; j < n; ++j) {
    const int parent = tree.joints()[j].parent;
    const bool carried_by_nothing =
        parent > 0 && tree.inertias()[parent].mass <= kNoMass * mass[0];
    // MakePointInertias() is for the point masses.
    if (carried_by_nothing && !IsPoint(tree.inertias()[j + 1], extent)) {
      moved.none[j] = moved.none[j] || dependent[j];
    }
  }
  return moved;
}

std::map<std::string, Inertia> MakePointInertias(const RobotModel& model) {
  const Tree& tree = model.tree;
  if (tree.num_joints() > kMostJoints || IsRegular(model)) return {};
  const double extent = Extent(tree);
  std::map<std::string, Inertia> inertias;
  for (int b = 0; b < tree.num_bodies(); ++b) {
    const Inertia& M = tree.inertias()[b];
    if (M.mass <= kNoMass * tree.total_mass() || !IsPoint(M, extent)) continue;
    inertias[LinkOf(model, b)] = Ball(0, M.mass, kSmallRadius * extent);
  }
  return inertias;
}

std::map<std::string, Inertia> MakeSmallInertias(const RobotModel& model) {
  const Tree& tree = model.tree;
  const double mass = kSmallMass * tree.total_mass();
  const double radius = kSmallRadius * Extent(tree);
  const auto has_mass = [&](int b) {
    return tree.inertias()[b].mass > kNoMass * tree.total_mass();
  };
  std::vector<bool> carries(tree.num_bodies());
  for (int b = tree.num_joints(); b > 0; --b) {
    if (has_mass(b)) carries[b] = true;
    if (carries[b]) carries[tree.joints()[b - 1].parent] = true;
  }
  std::map<std::string, Inertia> inertias;
  for (int b = 0; b < tree.num_bodies(); ++b) {
    if (!carries[b] || has_mass(b)) continue;
    inertias[LinkOf(model, b)] = Ball(mass, mass, radius);
  }
  // A small inertia must not hide that M is singular.
  if (inertias.empty() || tree.num_joints() > kMostJoints) return {};
  if (!IsRegular(model)) return {};
  return inertias;
}

std::optional<Finding> WarnOfMassless(const std::vector<std::string>& joints) {
  constexpr size_t kNamed = 3;
  if (joints.empty()) return std::nullopt;
  std::string names;
  for (size_t i = 0; i < std::min(kNamed, joints.size()); ++i) {
    names += (i > 0 ? ", " : "") + Quoted(joints[i]);
  }
  if (joints.size() > kNamed) names += ", ...";
  return Finding{
      Severity::kWarn, "robot",
      "has " + std::to_string(joints.size()) +
          (joints.size() == 1 ? " joint that moves" : " joints that move") +
          " no mass of " + (joints.size() == 1 ? "its" : "their") +
          " own: " + names,
      "locked, because no acceleration can be computed: give each link "
      "that a joint moves a mass",
      0};
}

}  // namespace poise
