// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/check_inertia.h"

#include <Eigen/Eigenvalues>
#include <string>

#include "poise/dynamics/tick.h"
#include "poise/robot/limits.h"

namespace poise {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostJoints = 500;
// Smallest eigenvalue per degree of freedom that exceeds rounding errors. It is
// that of M, scaled to a unit diagonal.
constexpr double kSingular = 1e-13;
// Eigenvalue below which the inverse of M loses half the digits.
constexpr double kIllConditioned = 1e-8;

// Names the joint or base that coordinate i of v moves.
std::string Coordinate(const RobotModel& model, int i) {
  const int j = i - model.tree.v_start();
  if (j >= 0) return "joint " + Quoted(model.tree.joints()[j].name);
  return "base " + Quoted(model.tree.frames()[model.root_frame].name);
}

// Returns " (link 'hand' and beyond)", the links that a joint moves, or nothing
// for the base.
std::string From(const RobotModel& model, int i) {
  const int j = i - model.tree.v_start();
  for (const Frame& frame : model.tree.frames()) {
    if (j < 0 || frame.body != j + 1) continue;
    return " (link " + Quoted(frame.name) + " and beyond)";
  }
  return "";
}

}  // namespace

std::optional<double> CheckInertia(const RobotModel& model,
                                   std::vector<Finding>* findings) {
  const Tree& tree = model.tree;
  const auto add = [&](Severity severity, const std::string& where,
                       const std::string& what, const std::string& why) {
    findings->push_back({severity, where, what, why, 0});
  };
  if (tree.num_joints() > kMostJoints) {
    add(Severity::kNote, "robot",
        "has " + std::to_string(tree.num_joints()) + " joints",
        "M was not computed, because the limit is 500 joints");
    return std::nullopt;
  }
  Tick tick(tree, {});
  ComputeTick(tree, RestConfiguration(model), VectorXd::Zero(tree.nv()), &tick);
  constexpr double kTooLarge = 1e20;  // Next to it, 1 is lost in rounding.
  if (!tick.M.allFinite() || tick.M.maxCoeff() > kTooLarge) {
    add(Severity::kWarn, "robot", "M is too large or not finite",
        "masses, inertias or lengths are too large to compute with");
    return std::nullopt;
  }
  const VectorXd diagonal = tick.M.diagonal();
  for (int i = 0; i < tree.nv(); ++i) {
    if (diagonal[i] > 0) continue;
    const bool nothing = diagonal[i] == 0;
    add(Severity::kWarn, Coordinate(model, i),
        (nothing ? "moves no mass" : "has negative inertia") + From(model, i),
        "M is singular or indefinite: no acceleration can be computed");
    return std::nullopt;
  }
  const VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(
      scale.asDiagonal() * tick.M * scale.asDiagonal());
  const double smallest = eigen.eigenvalues()[0];
  int i = 0;
  eigen.eigenvectors().col(0).cwiseAbs().maxCoeff(&i);
  if (smallest < -kSingular * tree.nv()) {
    add(Severity::kWarn, Coordinate(model, i), "makes M indefinite",
        "kinetic energy can be negative: an inertia is unphysical");
    return std::nullopt;
  }
  if (smallest < kSingular * tree.nv()) {
    add(Severity::kWarn, Coordinate(model, i), "makes M singular",
        "other joints move the same mass: no acceleration can be computed");
    return std::nullopt;
  }
  if (smallest < kIllConditioned) {
    add(Severity::kNote, Coordinate(model, i),
        "makes M ill-conditioned, with a condition number of at least " +
            PrintNumber(1 / smallest),
        "rounding errors of accelerations grow by this factor");
  }
  return smallest;
}

}  // namespace poise
