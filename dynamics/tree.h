// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "poise/dynamics/simd/joint_maps.h"
#include "poise/dynamics/simd/mass_moments.h"
#include "poise/math/inertia.h"
#include "poise/math/pose.h"

namespace poise {

/// How a joint lets its child move. A continuous joint is a revolute one without
/// limits, which is no matter of dynamics; the name is kept for who asks.
enum class JointType { kFixed, kRevolute, kContinuous, kPrismatic };

/// Whether the root link stands still at the world's origin, or moves freely.
enum class BaseType { kFixed, kFloating };

/// A joint as the builder takes it: child frame = parent frame, moved by X_PF
/// (constant), then by the joint about or along axis_F.
struct JointSpec {
  std::string name;
  JointType type = JointType::kFixed;
  std::string parent;  ///< Name of a link.
  std::string child;   ///< Name of a link.
  Pose X_PF;  ///< Joint frame F on the parent link P, at q = 0 the child.
  Eigen::Vector3d axis_F = Eigen::Vector3d::UnitX();
  double armature =
      0;  ///< Rotor inertia times gear ratio squared, kg m2 (or kg).
};

/// A moving joint of a Tree. Joint j moves body j + 1; body 0 is the base.
struct Joint {
  std::string name;
  JointType type;
  int parent;              ///< Body that carries it.
  Pose X_PF;               ///< Joint frame F on the parent body P.
  Eigen::Vector3d axis_F;  ///< Unit vector.
  double armature;         ///< On M's diagonal, kg m2 (or kg).
};

/// A named frame fixed in a body: every link given to the builder has one.
struct Frame {
  std::string name;
  int body;
  Pose X_BF;
};

/// The immutable model of a kinematic tree: bodies, joined by revolute and
/// prismatic joints, on a floating or a fixed base. Fixed and locked joints are
/// merged, their links still addressable as frames. Bodies stand depth first:
/// the parent of a body has a smaller index, and a subtree is contiguous.
///
/// State, for a floating base (a fixed one has the joints alone):
///
/// | | entries | size |
/// | q | p_WB; quaternion of R_WB (x, y, z, w); joints | nq = n + 7 |
/// | v | w_WB_W; v_WB_W; joint rates | nv = n + 6 |
///
/// p_WB and v_WB are those of the origin of the root link. v is not q's rate:
/// q moves by Integrate(). It is the paper's q̇, and q its [x; q_j] of (7).
class Tree {
 public:
  int num_bodies() const { return static_cast<int>(inertias_.size()); }
  int num_joints() const { return static_cast<int>(joints_.size()); }
  bool is_floating() const { return base_ == BaseType::kFloating; }
  int nq() const { return num_joints() + (is_floating() ? 7 : 0); }
  int nv() const { return num_joints() + (is_floating() ? 6 : 0); }

  /// Where the joints start in q and in v.
  int q_start() const { return is_floating() ? 7 : 0; }
  int v_start() const { return is_floating() ? 6 : 0; }

  /// In the order of q and v.
  const std::vector<Joint>& joints() const { return joints_; }
  /// By body, in the axes and about the origin of the body's frame.
  const std::vector<Inertia>& inertias() const { return inertias_; }
  /// One for each link given to the builder, the root's first.
  const std::vector<Frame>& frames() const { return frames_; }

  /// joints() and inertias() again, as the recursions take them.
  const JointMaps& joint_maps() const { return joint_maps_; }
  const MassMomentsArray& mass_moments() const { return mass_moments_; }

  /// The index of a name in joints() or frames(), if it is there. Costs O(n):
  /// for setup, not for each tick.
  std::optional<int> FindJoint(std::string_view name) const;
  std::optional<int> FindFrame(std::string_view name) const;

  /// kg.
  double total_mass() const { return total_mass_; }
  /// Acceleration of free fall, (0, 0, -9.81) m/s2 unless the builder was told.
  const Eigen::Vector3d& gravity_W() const { return gravity_W_; }

  /// The q at which all joints are zero and the base is at the world's origin.
  Eigen::VectorXd MakeNeutral() const;

  /// The same tree with all masses and moments of inertia, armature too, times
  /// a factor: what an error in the masses is tried with. Throws
  /// std::invalid_argument if the factor is not positive and finite.
  Tree WithScaledInertias(double factor) const;

 private:
  friend class TreeBuilder;
  Tree() = default;

  BaseType base_ = BaseType::kFloating;
  std::vector<Joint> joints_;
  std::vector<Inertia> inertias_;
  std::vector<Frame> frames_;
  JointMaps joint_maps_;
  MassMomentsArray mass_moments_;
  double total_mass_ = 0;
  Eigen::Vector3d gravity_W_{0, 0, -9.81};
};

/// Builds a Tree from links and joints, given in any order.
class TreeBuilder {
 public:
  /// Of the inertia the symmetric part counts. It may miss the triangle
  /// inequality, as that of a thin plate in six digits does: see FindDefect().
  TreeBuilder& AddLink(std::string name, const Inertia& M_L = {});
  /// From now on links may have negative principal moments, and moments without
  /// mass: no body has, but files of real robots do, and all can be computed.
  TreeBuilder& AcceptUnphysicalInertias();
  /// Its links may be added later.
  TreeBuilder& AddJoint(JointSpec joint);
  /// Fixes a moving joint at a value (rad or m): a reduced tree.
  TreeBuilder& Lock(std::string joint, double value);
  /// Acceleration of free fall, m/s2.
  TreeBuilder& SetGravity(const Eigen::Vector3d& gravity_W);

  /// All of the above and this throw std::invalid_argument, naming the link or
  /// joint, its value and what was wanted: no or several roots, a cycle, a link
  /// with two parents, an unknown or repeated name, a zero axis, a rotation that
  /// is none, an inertia that no body has, a number that is not finite. Axes may
  /// have any length, and rotations be off by 1e-5: the unit vector, and the
  /// nearest rotation, are taken. Joints stand depth first in q and v, not in
  /// the order they were added in: ask FindJoint().
  Tree Build(BaseType base = BaseType::kFloating) const;

 private:
  struct Link {
    std::string name;
    Inertia M;
  };
  struct LockedJoint {
    std::string name;
    double value;
  };
  std::vector<Link> links_;
  std::vector<JointSpec> joints_;
  std::vector<LockedJoint> locks_;
  bool physical_inertias_ = true;
  Eigen::Vector3d gravity_W_{0, 0, -9.81};
};

}  // namespace poise
