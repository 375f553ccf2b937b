// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/collision/body_capsules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "poise/dynamics/kinematics.h"
#include "poise/robot/collision/fit_capsule.h"

namespace poise {
namespace {

using Eigen::Vector3d;

// A body whose subtree has less than this fraction of the robot's mass belongs
// to its parent. A hand with all fingers is heavier, a finger is lighter.
constexpr double kLight = 0.005;

// A thick box is cut into bars until no capsule of a bar stands out of its
// faces by more than this fraction of the reach, or until there are four bars.
constexpr double kExcess = 0.03;

// The shapes of a body have a capsule each if these stand out by less than this
// fraction of what one capsule around all of them stands out.
constexpr double kTogether = 0.7;

// A link of a compound joint is shorter than this fraction of the reach, from
// its joint to those of its children.
constexpr double kShort = 0.05;

// A body without shapes is this thick, relative to its length.
constexpr double kSlim = 0.1;

using Parts = std::vector<std::vector<Ball>>;  // Balls by shape of a body.

double HalfDiagonal(double a, double b) { return std::hypot(a, b) / 2; }

// Cuts a box into bars along its longest side.
Parts CutBox(const Vector3d& size, const Pose& X_BS, double excess) {
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](int i, int j) { return size[i] > size[j]; });
  const double b = size[order[1]], c = size[order[2]];
  int across = 1, deep = 1;
  constexpr std::pair<int, int> kCuts[] = {{1, 1}, {2, 1}, {3, 1}, {2, 2}};
  for (const auto& [nb, nc] : kCuts) {
    across = nb;
    deep = nc;
    const double radius = HalfDiagonal(b / nb, c / nc);
    if (radius - std::min(b / nb, c / nc) / 2 <= excess) break;
  }
  Parts parts;
  for (int i = 0; i < across; ++i) {
    for (int j = 0; j < deep; ++j) {
      Vector3d bar = size;
      bar[order[1]] = b / across;
      bar[order[2]] = c / deep;
      Pose X_SP;
      X_SP.p[order[1]] = b * ((i + 0.5) / across - 0.5);
      X_SP.p[order[2]] = c * ((j + 0.5) / deep - 0.5);
      parts.push_back(BallsOfShape(Box{bar}, X_BS * X_SP));
    }
  }
  return parts;
}

// Returns by body the body whose capsules contain its shapes.
std::vector<int> FindCarriers(const Tree& tree) {
  std::vector<double> mass(tree.num_bodies());
  for (int b = tree.num_bodies() - 1; b >= 0; --b) {
    mass[b] += tree.inertias()[b].mass;
    if (b > 0) mass[tree.joints()[b - 1].parent] += mass[b];
  }
  std::vector<int> carrier(tree.num_bodies());
  for (int b = 1; b < tree.num_bodies(); ++b) {
    const bool is_light = mass[b] < kLight * tree.total_mass();
    carrier[b] = is_light ? carrier[tree.joints()[b - 1].parent] : b;
  }
  return carrier;
}

// Returns by body the distance from its joint to the farthest joint of a child;
// 0 without children.
std::vector<double> BoneLengths(const Tree& tree) {
  std::vector<double> length(tree.num_bodies());
  for (const Joint& joint : tree.joints()) {
    length[joint.parent] = std::max(length[joint.parent], joint.X_PF.p.norm());
  }
  return length;
}

std::vector<bool> HaveChildren(const Tree& tree) {
  std::vector<bool> have(tree.num_bodies());
  for (const Joint& joint : tree.joints()) have[joint.parent] = true;
  return have;
}

// Returns by how much capsules stand out of balls, m: the mean over directions
// of space.
double MeanExcess(const std::vector<Capsule>& capsules,
                  const std::vector<Ball>& balls) {
  double sum = 0;
  int directions = 0;
  for (int i = 0; i < 27; ++i) {
    const Vector3d corner(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (corner.isZero()) continue;
    const Vector3d n = corner.normalized();
    double outer = -INFINITY, inner = -INFINITY;
    for (const Capsule& c : capsules) {
      outer =
          std::max(outer, std::max(n.dot(c.start), n.dot(c.end)) + c.radius);
    }
    for (const Ball& ball : balls) {
      inner = std::max(inner, n.dot(ball.center) + ball.radius);
    }
    sum += outer - inner;
    ++directions;
  }
  return sum / directions;
}

// Returns the capsules around the parts: one, or one for each part.
std::vector<Capsule> Surround(const Parts& parts) {
  std::vector<Ball> all;
  std::vector<Capsule> each;
  for (const std::vector<Ball>& part : parts) {
    if (part.empty()) continue;
    all.insert(all.end(), part.begin(), part.end());
    each.push_back(FitCapsule(part));
  }
  if (all.empty()) return {};
  const std::vector<Capsule> one{FitCapsule(all)};
  const bool is_split =
      each.size() <= kMostCapsules &&
      MeanExcess(each, all) < kTogether * MeanExcess(one, all);
  return is_split ? each : one;
}

// Adds the shapes of one kind by body, each body's in its frame.
std::vector<Parts> PartsOf(const RobotModel& model,
                           const std::vector<Shape>& shapes, double excess) {
  std::vector<Parts> parts(model.tree.num_bodies());
  for (const Shape& shape : shapes) {
    const Frame& F = model.tree.frames()[shape.frame];
    const Pose X_BS = F.X_BF * shape.X_FS;
    if (const auto* box = std::get_if<Box>(&shape.geometry)) {
      for (auto& bar : CutBox(box->size, X_BS, excess)) {
        parts[F.body].push_back(std::move(bar));
      }
      continue;
    }
    auto balls = BallsOfShape(shape.geometry, X_BS);
    if (!balls.empty()) parts[F.body].push_back(std::move(balls));
  }
  return parts;
}

// Returns the segments from a body's joint to those of its children.
Parts Bones(const Tree& tree, int body) {
  Parts parts;
  for (const Joint& joint : tree.joints()) {
    const double length = joint.X_PF.p.norm();
    if (joint.parent != body || !(length > 0)) continue;
    parts.push_back(
        {{Vector3d::Zero(), kSlim * length}, {joint.X_PF.p, kSlim * length}});
  }
  return parts;
}

}  // namespace

double Reach(const Tree& tree) {
  std::vector<double> length(tree.num_bodies());
  for (int b = 1; b < tree.num_bodies(); ++b) {
    const Joint& joint = tree.joints()[b - 1];
    length[b] = length[joint.parent] + joint.X_PF.p.norm();
  }
  return *std::max_element(length.begin(), length.end());
}

std::vector<std::vector<Capsule>> FitBodyCapsules(const RobotModel& model,
                                                  const SurfacePoints& points) {
  const Tree& tree = model.tree;
  const double reach = Reach(tree);
  const double excess = kExcess * reach;
  std::vector<Parts> parts = PartsOf(model, model.collisions, excess);
  std::vector<Parts> visuals = PartsOf(model, model.visuals, excess);
  const std::vector<bool> has_children = HaveChildren(tree);
  const std::vector<double> bone = BoneLengths(tree);
  for (int b = 0; b < tree.num_bodies(); ++b) {
    if (!points.empty() && !points[b].empty()) {
      auto& part = parts[b].emplace_back();
      for (const Vector3d& p : points[b]) part.push_back({p, 0});
    }
    const bool is_inside_joint =
        b > 0 && has_children[b] && bone[b] < kShort * reach;
    if (parts[b].empty() && is_inside_joint) continue;
    if (parts[b].empty()) parts[b] = std::move(visuals[b]);
    if (parts[b].empty()) parts[b] = Bones(tree, b);
  }
  const std::vector<int> carrier = FindCarriers(tree);
  std::vector<Pose> X_WB(tree.num_bodies());
  ComputePoses(tree, tree.MakeNeutral(), &X_WB);
  std::vector<std::vector<Capsule>> capsules(tree.num_bodies());
  for (int b = tree.num_bodies() - 1; b >= 0; --b) {
    if (carrier[b] == b) continue;
    const Pose X_CB = X_WB[carrier[b]].Inverse() * X_WB[b];
    for (std::vector<Ball>& part : parts[b]) {
      for (Ball& ball : part) ball.center = X_CB * ball.center;
      parts[carrier[b]].push_back(std::move(part));
    }
  }
  for (int b = 0; b < tree.num_bodies(); ++b) {
    if (carrier[b] == b) capsules[b] = Surround(parts[b]);
  }
  return capsules;
}

}  // namespace poise
