// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/leg_end.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poise {
namespace {

using Eigen::Vector3d;

// A body of less than this part of the robot's mass, without a shape, is not
// the end of a leg.
constexpr double kNoMass = 1e-4;
// Parts of the leg's length. kLevel: an end is at most this far above the
// lowest point. A toe's joint is at most kToeHeight above it, the ankle at most
// kAnkleHeight, and the toe's joint at least kToeAhead in front of the ankle.
constexpr double kLevel = 0.05;
constexpr double kToeHeight = 0.15;
constexpr double kAnkleHeight = 0.3;
constexpr double kToeAhead = 0.05;
// Least cosine of two parallel axes.
constexpr double kParallel = 0.8;

// Returns for each body whether the body, or one that it carries, has a mass or
// a shape.
std::vector<bool> HasContent(const RobotModel& model) {
  const Tree& tree = model.tree;
  std::vector<bool> has(tree.num_bodies());
  for (int b = 0; b < tree.num_bodies(); ++b) {
    has[b] = tree.inertias()[b].mass > kNoMass * tree.total_mass();
  }
  for (const std::vector<Shape>* shapes : {&model.visuals, &model.collisions}) {
    for (const Shape& shape : *shapes) {
      has[tree.frames()[shape.frame].body] = true;
    }
  }
  for (int b = tree.num_bodies() - 1; b > 0; --b) {
    if (has[b]) has[tree.joints()[b - 1].parent] = true;
  }
  return has;
}

}  // namespace

std::vector<double> LowestPoints(const RobotModel& model,
                                 const std::vector<Outline>& outlines,
                                 const std::vector<Pose>& X_BB,
                                 const Vector3d& up_B) {
  std::vector<double> low(X_BB.size(), std::numeric_limits<double>::infinity());
  for (size_t b = 0; b < X_BB.size(); ++b) {
    if (b > 0) low[b] = up_B.dot(X_BB[b].p);
    for (const Outline::Corner& corner : outlines[b].corners) {
      low[b] = std::min(low[b], up_B.dot(X_BB[b] * corner.p_B) - corner.radius);
    }
  }
  for (const std::vector<Shape>* shapes : {&model.visuals, &model.collisions}) {
    for (const Shape& shape : *shapes) {
      const Frame& frame = model.tree.frames()[shape.frame];
      low[frame.body] =
          std::min(low[frame.body], up_B.dot(X_BB[frame.body] * frame.X_BF.p));
    }
  }
  return low;
}

LegEnd FindLegEnd(const RobotModel& model, const std::vector<Pose>& X_BB,
                  const std::vector<double>& low, int hip, const Vector3d& up_B,
                  double length) {
  const Tree& tree = model.tree;
  const std::vector<bool> has_content = HasContent(model);
  const auto parent = [&](int b) { return tree.joints()[b - 1].parent; };
  // A subtree is contiguous. The bodies of the leg are hip to end - 1.
  int end = hip + 1;
  while (end < tree.num_bodies() && parent(end) >= hip) ++end;
  std::vector<bool> is_end(end - hip, true);
  double lowest = low[hip];
  for (int b = hip + 1; b < end; ++b) {
    if (!has_content[b]) continue;
    lowest = std::min(lowest, low[b]);
    is_end[parent(b) - hip] = false;
  }
  int foot = -1;
  double heaviest = -1;
  for (int b = hip; b < end; ++b) {
    if (!is_end[b - hip] || (b > hip && !has_content[b])) continue;
    // A heavy end far above the ground must not precede a light one below.
    const double mass = low[b] <= lowest + kLevel * length
                            ? tree.inertias()[b].mass
                            : -low[b] + lowest;
    if (foot < 0 || mass > heaviest) {
      heaviest = mass;
      foot = b;
    }
  }

  const auto height = [&](int b) { return up_B.dot(X_BB[b].p) - lowest; };
  const auto axis = [&](int b) -> Vector3d {
    return X_BB[b].R * tree.joints()[b - 1].axis_F;
  };
  const auto is_toe = [&](int toe) {
    if (height(toe) > kToeHeight * length) return false;
    for (int b = parent(toe); b > hip; b = parent(b)) {
      if (height(b) > kAnkleHeight * length) return false;
      if (std::abs(axis(b).dot(axis(toe))) < kParallel) continue;
      const Vector3d p_AT = X_BB[toe].p - X_BB[b].p;
      const double down = std::abs(p_AT.dot(up_B));
      const Vector3d ahead = p_AT - p_AT.dot(up_B) * up_B;
      return ahead.norm() > std::max(down, kToeAhead * length);
    }
    return false;
  };
  LegEnd result{foot, {}};
  while (result.foot > hip && is_toe(result.foot)) {
    result.toes.push_back(result.foot - 1);
    result.foot = parent(result.foot);
  }
  return result;
}

}  // namespace poise
