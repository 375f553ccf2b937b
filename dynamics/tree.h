// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "poise/dynamics/body_arrays.h"
#include "poise/dynamics/joint_maps.h"
#include "poise/math/inertia.h"
#include "poise/math/pose.h"

namespace poise {

/// JointType is the motion that a joint allows. A continuous joint is a
/// revolute joint without limits; the dynamics treat both alike.
enum class JointType { kFixed, kRevolute, kContinuous, kPrismatic };

/// BaseType says whether the root link is fixed at the world's origin or
/// floats.
enum class BaseType { kFixed, kFloating };

/// JointSpec describes a joint to the builder. The child's frame is the
/// parent's frame, moved by the constant X_PF and then by the joint about or
/// along axis_F.
struct JointSpec {
  std::string name;
  JointType type = JointType::kFixed;
  std::string parent;  ///< Name of a link.
  std::string child;   ///< Name of a link.
  Pose X_PF;  ///< Joint frame F on the parent link P; the child's at q = 0.
  Eigen::Vector3d axis_F = Eigen::Vector3d::UnitX();
  double armature =
      0;  ///< Rotor inertia times gear ratio squared, kg m2 (or kg).
};

/// Joint is a moving joint of a Tree. Joint j moves body j + 1; body 0 is the
/// base.
struct Joint {
  std::string name;
  JointType type;
  int parent;              ///< Body that carries the joint.
  Pose X_PF;               ///< Joint frame F on the parent body P.
  Eigen::Vector3d axis_F;  ///< Unit vector.
  double armature;         ///< On M's diagonal, kg m2 (or kg).
};

/// Frame is a named frame fixed in a body. Every link of the builder has a
/// frame.
struct Frame {
  std::string name;
  int body;
  Pose X_BF;
};

/// Tree is the immutable model of a kinematic tree: bodies, connected by
/// revolute and prismatic joints, on a floating or a fixed base. Links behind a
/// fixed or locked joint are merged into one body; their frames remain. Bodies
/// are in depth-first order: a parent has a smaller index, and a subtree is
/// contiguous.
///
/// The state with a floating base is as follows; a fixed base has joints only.
///
/// | | entries | size |
/// | q | p_WB; quaternion of R_WB (x, y, z, w); joints | nq = n + 7 |
/// | v | w_WB_W; v_WB_W; joint rates | nv = n + 6 |
///
/// p_WB and v_WB belong to the origin of the root link. v is not the time
/// derivative of q: Integrate() moves q along v. The paper writes q̇ for v and
/// [x; q_j] for q, see (7).
class Tree {
 public:
  int num_bodies() const { return static_cast<int>(inertias_.size()); }
  int num_joints() const { return static_cast<int>(joints_.size()); }
  bool is_floating() const { return base_ == BaseType::kFloating; }
  int nq() const { return num_joints() + (is_floating() ? 7 : 0); }
  int nv() const { return num_joints() + (is_floating() ? 6 : 0); }

  /// Indices of the first joint in q and in v.
  int q_start() const { return is_floating() ? 7 : 0; }
  int v_start() const { return is_floating() ? 6 : 0; }

  /// Moving joints, in the order of q and v.
  const std::vector<Joint>& joints() const { return joints_; }
  /// Inertias by body, about the origin and in the axes of the body's frame.
  const std::vector<Inertia>& inertias() const { return inertias_; }
  /// Frames, one for each link of the builder, the root's first.
  const std::vector<Frame>& frames() const { return frames_; }

  /// Copies of joints() and inertias() in the form of the recursions.
  const JointMaps& joint_maps() const { return joint_maps_; }
  const MassMomentsArray& mass_moments() const { return mass_moments_; }

  /// Returns the index of a name in joints() or frames(), if the name exists.
  /// Costs O(n): for setup, not for each tick.
  std::optional<int> FindJoint(std::string_view name) const;
  std::optional<int> FindFrame(std::string_view name) const;

  /// Sum of the masses of all links, kg.
  double total_mass() const { return total_mass_; }
  /// Acceleration of free fall, m/s2; see TreeBuilder::SetGravity().
  const Eigen::Vector3d& gravity_W() const { return gravity_W_; }

  /// Returns the q with all joints at zero and the base at the world's origin.
  Eigen::VectorXd MakeNeutral() const;

  /// Returns this tree with all masses, moments of inertia and armatures
  /// multiplied by a factor, to test an error in the masses. Throws
  /// std::invalid_argument if the factor is not positive and finite.
  Tree WithScaledInertias(double factor) const;

  /// Returns this tree on another base. A fixed base is the root link at the
  /// world's origin, as of an arm on a table: q and v have the joints only.
  Tree WithBase(BaseType base) const;

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

/// TreeBuilder builds a Tree from links and joints, added in any order.
class TreeBuilder {
 public:
  /// Adds a link. The builder takes the symmetric part of the inertia. The
  /// inertia may violate the triangle inequality, as the rounded moments of a
  /// thin plate do: see FindDefect().
  TreeBuilder& AddLink(std::string name, const Inertia& M_L = {});
  /// Accepts negative principal moments, and moments without mass, of links
  /// added later. No body has such an inertia, but files of real robots do.
  TreeBuilder& AcceptUnphysicalInertias();
  /// Adds a joint, before or after its links.
  TreeBuilder& AddJoint(JointSpec joint);
  /// Fixes a moving joint at a value (rad or m): a reduced tree.
  TreeBuilder& Lock(std::string joint, double value);
  /// Sets the acceleration of free fall, m/s2; (0, 0, -9.81) by default.
  TreeBuilder& SetGravity(const Eigen::Vector3d& gravity_W);

  /// Builds the tree. Build() and the functions above throw
  /// std::invalid_argument, which names the link or joint, its value and the
  /// valid range, if
  /// - there is no root, or there are several; a cycle; a link with two
  ///   parents,
  /// - a name is unknown or repeated,
  /// - an axis is zero, or a matrix deviates from a rotation by more than 1e-5,
  /// - an inertia is unphysical, or a number is not finite.
  /// An axis may have any length. The nearest rotation replaces each rotation.
  /// Joints are in depth-first order in q and v, not in the order of
  /// AddJoint(): use FindJoint().
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
