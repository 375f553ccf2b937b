// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/self_collision.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "poise/dynamics/kinematics.h"
#include "poise/robot/control/tasks/row_names.h"

namespace poise {
namespace {

using Eigen::Vector3d;

// Softness of the distance, see ComputeClosestPoints(). The distance of
// parallel segments of 0.3 m at 0.1 m is then 2 mm too small, and the closest
// points move from end to end within about 0.1 rad.
constexpr double kSoftness = 0.01;

// Defaults of the parameters, relative to the reach and to the frequency of a
// pendulum of this length.
constexpr double kMinDistance = 0.01;
constexpr double kOmega = 34.5;

// Bodies that are too near are moved apart at this speed at most, relative to
// the speed of a fall over half of the reach.
constexpr double kApart = 0.03;

// A row is loosened to infinity at this acceleration, relative to gravity.
constexpr double kLoosest = 1;

// A pair whose bounding balls are farther apart than this fraction of the reach
// is not near.
constexpr double kFar = 0.2;

double GravityOf(const Tree& tree) {
  const double gravity = tree.gravity_W().norm();
  return gravity > 0 ? gravity : 9.81;
}

std::vector<double> NominalDistances(const Robot& robot,
                                     const CollisionModel& model) {
  const Tree& tree = robot.model.tree;
  const bool has_posture = robot.q_nominal.size() == tree.nq();
  std::vector<Pose> X_WB(tree.num_bodies());
  ComputePoses(tree, has_posture ? robot.q_nominal : tree.MakeNeutral(), &X_WB);
  std::vector<double> distances;
  for (const CollisionPair& pair : model.pairs) {
    distances.push_back(
        ComputePairDistance(model, pair, X_WB, kSoftness).distance);
  }
  return distances;
}

// Returns the model without the pairs that overlap too deeply in the nominal
// posture.
CollisionModel WithoutOverlaps(const Robot& robot, CollisionModel model) {
  const std::vector<double> nominal = NominalDistances(robot, model);
  std::vector<CollisionPair> pairs;
  for (size_t i = 0; i < nominal.size(); ++i) {
    const auto radius = [&](int body) {
      double least = INFINITY;
      for (const Capsule& c : model.capsules[body]) {
        least = std::min(least, c.radius);
      }
      return least;
    };
    const CollisionPair& pair = model.pairs[i];
    const double smaller = std::min(radius(pair.a), radius(pair.b));
    const auto is_foot = [&](int body) {
      return std::any_of(robot.feet.begin(), robot.feet.end(),
                         [&](const Foot& foot) { return foot.body == body; });
    };
    // A foot is flat, its capsule is not. Feet side by side would be too near.
    if (is_foot(pair.a) && is_foot(pair.b)) continue;
    if (nominal[i] > -smaller / 2) pairs.push_back(pair);
  }
  model.pairs = std::move(pairs);
  return model;
}

// Returns by body the leg that it belongs to: the index of a foot at the end of
// its chain, or -1. A body of several legs belongs to none.
std::vector<int> FindLegs(const Robot& robot) {
  const Tree& tree = robot.model.tree;
  std::vector<int> leg(tree.num_bodies(), -1);
  std::vector<bool> is_shared(tree.num_bodies());
  for (int foot = 0; foot < static_cast<int>(robot.feet.size()); ++foot) {
    for (int b = robot.feet[foot].body; b > 0;
         b = tree.joints()[b - 1].parent) {
      is_shared[b] = is_shared[b] || leg[b] >= 0;
      leg[b] = is_shared[b] ? -1 : foot;
    }
  }
  return leg;
}

// Returns how far the rows that keep arms off other bodies are loosened: 0 (as
// they are) to 1 (no rows). Arms that swing for balance may need the space.
double LoosenessOfArms(const TaskInput& input) noexcept {
  const bool swings_a_leg =
      std::any_of(input.contacts.begin(), input.contacts.end(),
                  [](const ContactTick& contact) {
                    return !contact.in_contact && !contact.is_guided;
                  });
  return swings_a_leg ? 1 : input.capture;
}

// Returns by joint the largest distance from its axis to a capsule that it
// moves while all sliders are at 0, m. The sum of these times the joint rates
// is an upper bound of the speed of a point of a capsule relative to another.
std::vector<double> Levers(const Tree& tree, const CollisionModel& model) {
  std::vector<double> reach(tree.num_bodies(), 0);
  for (int b = tree.num_bodies() - 1; b > 0; --b) {
    if (!model.capsules[b].empty()) {
      const CollisionBound& bound = model.bounds[b];
      reach[b] = std::max(reach[b], bound.center.norm() + bound.radius);
    }
    const Joint& joint = tree.joints()[b - 1];
    if (reach[b] > 0) {
      reach[joint.parent] =
          std::max(reach[joint.parent], reach[b] + joint.X_PF.p.norm());
    }
  }
  return {reach.begin() + 1, reach.end()};
}

std::string Words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::vector<RowDescription> PairRows(const CollisionModel& model) {
  std::vector<RowDescription> rows;
  for (const CollisionPair& pair : model.pairs) {
    const std::string& a = model.names[pair.a];
    const std::string& b = model.names[pair.b];
    rows.push_back({"self_collision." + a + "." + b, "m",
                    "the distance between " + Words(a) + " and " + Words(b),
                    RowKind::kLimit});
  }
  return rows;
}

}  // namespace

SelfCollisionTask::SelfCollisionTask(const Robot& robot)
    : SelfCollisionTask(
          robot, WithoutOverlaps(robot, MakeCollisionModel(robot.model))) {}

SelfCollisionTask::SelfCollisionTask(const Robot& robot, CollisionModel model)
    : Task("self_collision", {}, PairRows(model)),
      model_(std::move(model)),
      joints_(robot.model.tree.joints()),
      q_start_(robot.model.tree.q_start()),
      v_start_(robot.model.tree.v_start()),
      lever_(Levers(robot.model.tree, model_)),
      leg_(FindLegs(robot)),
      nominal_(NominalDistances(robot, model_)),
      loosest_(kLoosest * GravityOf(robot.model.tree)),
      d_min_(kMinDistance * model_.reach),
      omega_(kOmega * std::sqrt(GravityOf(robot.model.tree) / model_.reach)),
      apart_(kApart * std::sqrt(GravityOf(robot.model.tree) * model_.reach)) {
  AddParameter("d_min", &d_min_, 0, 1);
  AddParameter("omega", &omega_, 1, 1000);
}

bool SelfCollisionTask::HasRows(const TaskInput& input) const noexcept {
  // A robot that catches itself by steps swings its arms past its thighs.
  // There, the rows would cost more balance than a touch.
  if (input.reference.pendulum.is_on) return false;
  const Common common = FindCommon(input);
  for (int i = 0; i < static_cast<int>(model_.pairs.size()); ++i) {
    if (FindBound(input, i, common).is_near) return true;
  }
  return false;
}

void SelfCollisionTask::Write(const TaskInput& input, EqualityBlock*,
                              InequalityBlock* inequalities) const noexcept {
  const Common common = FindCommon(input);
  const double scale = 4 / (omega_ * omega_ * model_.reach);
  for (int i = 0; i < static_cast<int>(model_.pairs.size()); ++i) {
    const Bound bound = FindBound(input, i, common);
    if (!bound.is_near) continue;
    const CollisionPair& pair = model_.pairs[i];
    const ClosestPoints& closest = bound.closest;
    const Vector3d gradient = scale * closest.gradient;
    auto row = inequalities->C.row(i);
    WriteChain(input.tick, pair.a, pair.ancestor, closest.p_A, gradient, row);
    WriteChain(input.tick, pair.b, pair.ancestor, closest.p_B, -gradient, row);
    inequalities->lower[i] = scale * bound.lower;
  }
}

// Computes the motion of the point Q of a body relative to an ancestor, at
// v̇ = 0. Seen from the parent of a body that turns with w at r from Q,
//     v' = v + w x r,   a' = a + 2 w x v + w x (w x r).
// Adds the acceleration of Q along the gradient at the unmodelled v̇.
SelfCollisionTask::PointMotion SelfCollisionTask::Relative(
    const TaskInput& input, int body, int ancestor, const Vector3d& p_WQ,
    const Vector3d& gradient, double* unmodelled) const noexcept {
  PointMotion motion;
  for (; body != ancestor; body = joints_[body - 1].parent) {
    const Joint& joint = joints_[body - 1];
    const int k = v_start_ + body - 1;
    const double rate = input.state.v[k];
    const Pose& X_WB = input.tick.X_WB[body];
    const Vector3d axis = X_WB.R * joint.axis_F;
    if (joint.type == JointType::kPrismatic) {
      motion.v += rate * axis;
      *unmodelled += gradient.dot(axis) * input.unmodelled_vdot[k];
      continue;
    }
    const Vector3d w = rate * axis;
    const Vector3d r = p_WQ - X_WB.p;
    motion.a += 2 * w.cross(motion.v) + w.cross(w.cross(r));
    motion.v += w.cross(r);
    *unmodelled += gradient.dot(axis.cross(r)) * input.unmodelled_vdot[k];
  }
  return motion;
}

SelfCollisionTask::Common SelfCollisionTask::FindCommon(
    const TaskInput& input) const noexcept {
  // Sliders lengthen the levers of other joints by their travel at most.
  double travel = 0;
  for (size_t j = 0; j < joints_.size(); ++j) {
    if (joints_[j].type != JointType::kPrismatic) continue;
    travel += std::abs(input.state.q[q_start_ + j]);
  }
  Common common{0, LoosenessOfArms(input), 0};
  for (size_t j = 0; j < joints_.size(); ++j) {
    const bool is_slider = joints_[j].type == JointType::kPrismatic;
    const double lever = is_slider ? 1 : lever_[j] + travel;
    common.max_speed += lever * std::abs(input.state.v[v_start_ + j]);
  }
  common.far = std::min(
      kFar * model_.reach,
      d_min_ + (loosest_ + 2 * omega_ * common.max_speed) / (omega_ * omega_));
  return common;
}

// Most pairs are so far apart that u cannot be below u_max at any direction of
// the motion. Balls around the bodies show this without the capsules' poses.
bool SelfCollisionTask::IsFar(const TaskInput& input, const CollisionPair& pair,
                              const Common& common) const noexcept {
  const CollisionBound& a = model_.bounds[pair.a];
  const CollisionBound& b = model_.bounds[pair.b];
  const double far = common.far + a.radius + b.radius;
  const std::vector<Pose>& X_WB = input.tick.X_WB;
  return (X_WB[pair.a] * a.center - X_WB[pair.b] * b.center).squaredNorm() >=
         far * far;
}

SelfCollisionTask::Bound SelfCollisionTask::FindBound(
    const TaskInput& input, int i, const Common& common) const noexcept {
  Bound bound;
  const CollisionPair& pair = model_.pairs[i];
  const bool is_of_legs = leg_[pair.a] >= 0 && leg_[pair.b] >= 0;
  const double looseness = is_of_legs ? 0 : common.looseness_of_arms;
  if (looseness >= 1 || IsFar(input, pair, common)) return bound;
  const std::vector<Pose>& X_WB = input.tick.X_WB;
  const double d_min =
      std::min({d_min_, nominal_[i] / 2, nominal_[i] - d_min_ / 2});
  bound.closest = ComputePairDistance(model_, pair, X_WB, kSoftness);
  const Vector3d& gradient = bound.closest.gradient;
  // In whichever direction the bodies move, ḋ is at least -|gradient|
  // max_speed.
  if (omega_ * omega_ * (bound.closest.distance - d_min) -
          2 * omega_ * gradient.norm() * common.max_speed >=
      loosest_) {
    return bound;
  }
  double unmodelled = 0;
  const PointMotion A = Relative(input, pair.a, pair.ancestor,
                                 bound.closest.p_A, gradient, &unmodelled);
  const PointMotion B = Relative(input, pair.b, pair.ancestor,
                                 bound.closest.p_B, -gradient, &unmodelled);
  const double spring = std::max(
      omega_ * omega_ * (bound.closest.distance - d_min), -2 * omega_ * apart_);
  const double u = 2 * omega_ * gradient.dot(A.v - B.v) + spring +
                   looseness / (1 - looseness) * loosest_;
  if (!(u < loosest_) || gradient.isZero()) return bound;
  bound.is_near = true;
  bound.lower = (u > 0 ? -u / (1 - u / loosest_) : -u) -
                gradient.dot(A.a - B.a) - unmodelled;
  return bound;
}

// Adds the derivative of gradient · p_WQ by the joints between a body and an
// ancestor.
void SelfCollisionTask::WriteChain(
    const Tick& tick, int body, int ancestor, const Vector3d& p_WQ,
    const Vector3d& gradient,
    Eigen::Ref<Eigen::RowVectorXd> row) const noexcept {
  for (; body != ancestor; body = joints_[body - 1].parent) {
    const Joint& joint = joints_[body - 1];
    const Pose& X_WB = tick.X_WB[body];
    const Vector3d axis = X_WB.R * joint.axis_F;
    const bool is_slider = joint.type == JointType::kPrismatic;
    row[v_start_ + body - 1] += is_slider
                                    ? gradient.dot(axis)
                                    : gradient.dot(axis.cross(p_WQ - X_WB.p));
  }
}

}  // namespace poise
