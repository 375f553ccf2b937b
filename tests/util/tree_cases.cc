// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/tree_cases.h"

#include <rapidcheck.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <ostream>
#include <random>

#include "poise/tests/util/random_tree.h"

namespace poise {
namespace {

bool OneIn(int n, std::mt19937* draw) { return (*draw)() % n == 0; }

Eigen::Matrix3d MakeRandomRotation(std::mt19937* draw) {
  const Eigen::Vector3d w = 3 * MakeRandomVector(3, draw);
  return Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix();
}

Inertia MakeRandomInertia(std::mt19937* draw) {
  Inertia M;
  M.mass = 1 + 0.9 * MakeRandomVector(1, draw)[0];
  M.p_BoG_B = 0.1 * MakeRandomVector(3, draw);
  const Eigen::Vector3d d = MakeRandomVector(3, draw).cwiseAbs();
  const Eigen::Matrix3d R = MakeRandomRotation(draw);
  // All second moments of the mass are positive, so the body is possible.
  const Eigen::Vector3d s = 0.01 * M.mass * (d.array() + 0.1).matrix();
  const Eigen::Vector3d I(s.y() + s.z(), s.z() + s.x(), s.x() + s.y());
  const Eigen::Matrix3d I_G = R * I.asDiagonal() * R.transpose();
  M.I_G_B = (I_G + I_G.transpose()) / 2;
  return M;
}

std::string Name(const char* what, int i) { return what + std::to_string(i); }

int MakeParent(TreeShape shape, int i, std::mt19937* draw) {
  switch (shape) {
    case TreeShape::kChain:
      return i - 1;
    case TreeShape::kStar:
      return 0;
    default:
      return static_cast<int>((*draw)() % i);
  }
}

JointType MakeJointType(std::mt19937* draw) {
  if (OneIn(4, draw)) return JointType::kPrismatic;
  return OneIn(3, draw) ? JointType::kContinuous : JointType::kRevolute;
}

JointSpec MakeJoint(int parent, int i, std::mt19937* draw) {
  JointSpec joint;
  joint.name = Name("joint", i);
  joint.type = MakeJointType(draw);
  joint.parent = Name("link", parent);
  joint.child = Name("link", i);
  joint.X_PF.p = 0.3 * MakeRandomVector(3, draw);
  if (!OneIn(3, draw)) joint.X_PF.R = MakeRandomRotation(draw);
  joint.axis_F = 2 * MakeRandomVector(3, draw);
  if (OneIn(2, draw)) {
    joint.axis_F = Eigen::Vector3d::Unit((*draw)() % 3);
    if (OneIn(2, draw)) joint.axis_F *= -1;
  }
  if (OneIn(4, draw)) joint.armature = 0.5;
  return joint;
}

}  // namespace

TreeMotion MakeTreeMotion(const TreeCase& from) {
  std::mt19937 draw(static_cast<unsigned>(from.seed));
  TreeBuilder builder;
  builder.SetGravity(10 * MakeRandomVector(3, &draw));
  const int n = from.num_joints;
  std::vector<int> parent(n + 1, 0);
  std::vector<bool> is_end(n + 1, true);
  for (int i = 1; i <= n; ++i) {
    parent[i] = MakeParent(from.shape, i, &draw);
    is_end[parent[i]] = false;
  }
  std::vector<bool> is_massless(n + 1, false);
  for (int i = 0; i <= n; ++i) {
    is_massless[i] =
        i > 0 && !is_end[i] && !is_massless[parent[i]] && OneIn(5, &draw);
    builder.AddLink(Name("link", i),
                    is_massless[i] ? Inertia() : MakeRandomInertia(&draw));
    if (i == 0) continue;
    JointSpec joint = MakeJoint(parent[i], i, &draw);
    if (!is_massless[i] && OneIn(6, &draw)) joint.type = JointType::kFixed;
    if (i == 3 && joint.type != JointType::kFixed) {
      builder.Lock(joint.name, 0.7);
    }
    builder.AddJoint(joint);
  }
  TreeMotion motion{builder.Build(from.base), {}, {}, {}, {}};
  const Tree& tree = motion.tree;
  motion.q = 3 * MakeRandomVector(tree.nq(), &draw);
  if (tree.is_floating()) motion.q.segment<4>(3).normalize();
  motion.v = 2 * MakeRandomVector(tree.nv(), &draw);
  motion.vdot = 2 * MakeRandomVector(tree.nv(), &draw);
  for (int b = 0; b < tree.num_bodies(); ++b) {
    motion.F_Bo_W.emplace_back(Vector6d(5 * MakeRandomVector(6, &draw)));
  }
  return motion;
}

Residual Compare(const Eigen::Ref<const Eigen::MatrixXd>& A,
                 const Eigen::Ref<const Eigen::MatrixXd>& B, double tolerance) {
  if (A.rows() != B.rows() || A.cols() != B.cols()) return {1, 0};
  double largest = 0;
  for (Eigen::Index i = 0; i < A.size(); ++i) {
    const double difference = std::abs(A.reshaped()[i] - B.reshaped()[i]);
    if (!(difference <= largest)) largest = difference;  // Keeps NaN.
  }
  return {largest, tolerance};
}

bool HoldsForTrees(
    const std::string& property,
    const std::function<Residual(const TreeMotion&)>& residual_of,
    int max_joints) {
  return rc::check(property, [&] {
    TreeCase from;
    from.shape =
        *rc::gen::element(TreeShape::kAny, TreeShape::kChain, TreeShape::kStar)
             .as("shape");
    from.base =
        *rc::gen::element(BaseType::kFloating, BaseType::kFixed).as("base");
    from.num_joints = *rc::gen::inRange(0, max_joints + 1).as("joints");
    from.seed = *rc::gen::inRange(0, 1000000).as("seed");
    const Residual residual = residual_of(MakeTreeMotion(from));
    RC_LOG() << "residual " << residual.value << ", tolerance "
             << residual.tolerance << std::endl;
    RC_ASSERT(residual.value <= residual.tolerance);
  });
}

}  // namespace poise
