// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/turn_strength.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/dynamics/tree.h"

namespace poise {
namespace {

// Cosine of the largest angle between a joint's axis and the axis of a turn.
constexpr double kAligned = 0.7;

// Returns the bodies from `body` to the base, both included.
std::vector<int> PathToBase(const Tree& tree, int body) {
  std::vector<int> path{body};
  while (path.back() != 0) {
    path.push_back(tree.joints()[path.back() - 1].parent);
  }
  return path;
}

bool Contains(const std::vector<int>& bodies, int body) {
  return std::find(bodies.begin(), bodies.end(), body) != bodies.end();
}

// Finds the torque with which the legs turn the trunk.
class Hips {
 public:
  explicit Hips(const Robot& robot)
      : robot_(robot), tree_(robot.model.tree), tick_(tree_, {}) {
    ComputeTick(tree_, robot.q_nominal, Eigen::VectorXd::Zero(tree_.nv()),
                &tick_);
    for (const Foot& foot : robot.feet) {
      legs_.push_back(PathToBase(tree_, foot.body));
    }
    for (const int body : legs_[0]) {
      if (!Contains(legs_[1], body)) continue;
      pelvis_ = body;
      break;
    }
    FindTrunk();
  }

  // Distance of the nominal soles' outer edge from their middle, m.
  Eigen::Vector2d Edge() const {
    Eigen::Vector2d edge = Eigen::Vector2d::Zero();
    double width = 0;
    for (const Foot& foot : robot_.feet) {
      edge += 0.5 * foot.half_size;
      width = (tick_.X_WB[foot.body] * foot.X_BC).p.y() - width;
    }
    edge.y() += std::abs(width) / 2;
    return edge;
  }

  double Torque(const Eigen::Vector3d& axis_W) const {
    double torque = 0;
    for (const std::vector<int>& leg : legs_) {
      double hip = 0;
      for (const int body : leg) {  // From the foot up: the hip is last.
        if (body == pelvis_) break;
        if (Turns(body, axis_W)) hip = Effort(body);
      }
      torque += hip;
    }
    for (const int body : trunk_) {
      if (Turns(body, axis_W)) torque = std::min(torque, Effort(body));
    }
    return torque;
  }

 private:
  bool Turns(int body, const Eigen::Vector3d& axis_W) const {
    const Joint& joint = tree_.joints()[body - 1];
    return joint.type != JointType::kPrismatic &&
           std::abs((tick_.X_WB[body].R * joint.axis_F).dot(axis_W)) > kAligned;
  }

  double Effort(int body) const { return robot_.model.limits[body - 1].effort; }

  // Finds the bodies whose joints carry the larger part of what is no leg, on
  // the way from the pelvis to the base and on from there.
  void FindTrunk() {
    std::vector<int> way = PathToBase(tree_, pelvis_);
    way.pop_back();
    trunk_ = way;
    const int bodies = tree_.num_bodies();
    std::vector<double> mass(bodies);
    for (int body = bodies - 1; body >= 0; --body) {
      mass[body] += tree_.inertias()[body].mass;
      if (body > 0) mass[tree_.joints()[body - 1].parent] += mass[body];
    }
    double upper = mass[0];
    for (const std::vector<int>& leg : legs_) {
      const auto pelvis = std::find(leg.begin(), leg.end(), pelvis_);
      if (pelvis != leg.begin()) upper -= mass[*(pelvis - 1)];
    }
    int at = 0;
    for (int body = 1; body < bodies; ++body) {
      const bool is_leg = Contains(legs_[0], body) || Contains(legs_[1], body);
      if (is_leg || tree_.joints()[body - 1].parent != at) continue;
      if (mass[body] < upper / 2) continue;
      trunk_.push_back(body);
      at = body;
    }
  }

  const Robot& robot_;
  const Tree& tree_;
  Tick tick_;
  std::vector<std::vector<int>> legs_;  // Bodies from the foot to the base.
  int pelvis_ = 0;                      // The last body that carries both legs.
  std::vector<int> trunk_;
};

}  // namespace

TurnStrength ComputeTurnStrength(const Robot& robot) {
  const Hips hips(robot);
  const Tree& tree = robot.model.tree;
  const double weight = tree.total_mass() * tree.gravity_W().norm();
  const Eigen::Vector2d edge = hips.Edge();
  return {hips.Torque(Eigen::Vector3d::UnitY()) / (weight * edge.x()),
          hips.Torque(Eigen::Vector3d::UnitX()) / (weight * edge.y())};
}

}  // namespace poise
