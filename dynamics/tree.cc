// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "dynamics/tree.h"

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

Eigen::VectorXd Tree::MakeNeutral() const {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(nq());
  if (is_floating()) q[6] = 1;
  return q;
}

}  // namespace poise
