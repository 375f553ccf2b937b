// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/tree.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "poise/dynamics/simd/mass_moments.h"

namespace poise {
namespace {

template <typename Item>
std::optional<int> Find(const std::vector<Item>& items, std::string_view name) {
  for (size_t i = 0; i < items.size(); ++i) {
    if (items[i].name == name) return static_cast<int>(i);
  }
  return std::nullopt;
}

}  // namespace

std::optional<int> Tree::FindJoint(std::string_view name) const {
  return Find(joints_, name);
}

std::optional<int> Tree::FindFrame(std::string_view name) const {
  return Find(frames_, name);
}

Tree Tree::WithScaledInertias(double factor) const {
  if (!(factor > 0) || !std::isfinite(factor)) {
    std::ostringstream message;
    message << "tree: factor of the inertias is " << factor
            << ", must be positive and finite";
    throw std::invalid_argument(message.str());
  }
  Tree scaled = *this;
  for (Inertia& M : scaled.inertias_) {
    M.mass *= factor;
    M.I_G_B *= factor;
  }
  for (int b = 0; b < num_bodies(); ++b) {
    scaled.mass_moments_.Set(b, MakeMassMoments(scaled.inertias_[b]));
  }
  for (Joint& joint : scaled.joints_) joint.armature *= factor;
  for (double& armature : scaled.joint_maps_.armature) armature *= factor;
  scaled.total_mass_ *= factor;
  return scaled;
}

Tree Tree::WithBase(BaseType base) const {
  Tree other = *this;
  other.base_ = base;
  return other;
}

Eigen::VectorXd Tree::MakeNeutral() const {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(nq());
  if (is_floating()) q[6] = 1;
  return q;
}

}  // namespace poise
