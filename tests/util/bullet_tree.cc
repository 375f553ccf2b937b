// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/bullet_tree.h"

#include <Eigen/Geometry>
#include <stdexcept>
#include <string>

#include "poise/dynamics/kinematics.h"
#include "poise/math/pose.h"

#ifdef POISE_HAS_BULLET_INVERSE_DYNAMICS

#include <LinearMath/btMatrix3x3.h>
#include <LinearMath/btMatrixX.h>

// Declares the part of libBulletInverseDynamics-float64.so.3.24 that we call:
// Debian has the library, but not its headers.
namespace btInverseDynamicsBullet3 {

struct vec3 : btVector3 {
  using btVector3::btVector3;
};
struct mat33 : btMatrix3x3 {
  using btMatrix3x3::btMatrix3x3;
};
struct vecx : btVectorX<double> {
  using btVectorX<double>::btVectorX;
};
using matxx = btMatrixX<double>;

enum JointType { FIXED, REVOLUTE, PRISMATIC, FLOATING };

class MultiBodyTree {
 public:
  MultiBodyTree();
  ~MultiBodyTree();
  void setAcceptInvalidMassParameters(bool flag);
  int addBody(int body, int parent, JointType type, const vec3& p_PF_P,
              const mat33& R_FP, const vec3& axis_F, double mass,
              const vec3& p_BoG_B, const mat33& I_Bo_B, int, void*);
  int finalize();
  int setGravityInWorldFrame(const vec3& g_W);
  void clearAllUserForcesAndMoments();
  int addUserForce(int body, const vec3& f_B);
  int addUserMoment(int body, const vec3& n_Bo_B);
  int calculateInverseDynamics(const vecx& q, const vecx& u, const vecx& dot_u,
                               vecx* forces);
  int calculateMassMatrix(const vecx& q, matxx* M);

 private:
  // Bullet has three flags and two pointers here; the rest is reserve.
  alignas(16) unsigned char members_[64];
};

}  // namespace btInverseDynamicsBullet3

namespace poise {

namespace id = btInverseDynamicsBullet3;

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

id::vec3 ToBullet(const Vector3d& x) { return {x.x(), x.y(), x.z()}; }

id::mat33 ToBullet(const Matrix3d& A) {
  return {A(0, 0), A(0, 1), A(0, 2), A(1, 0), A(1, 1),
          A(1, 2), A(2, 0), A(2, 1), A(2, 2)};
}

void Check(int error, const char* what) {
  if (error != 0) throw std::runtime_error(std::string("Bullet: ") + what);
}

}  // namespace

// For a floating base, Bullet's q holds the angles of R_WB = R_x R_y R_z and
// p_WB. Its u holds the angular and the linear velocity in the base's axes.
struct BulletTree::Bullet {
  explicit Bullet(const Tree& t)
      : tree(t),
        q(t.nv()),
        u(t.nv()),
        dot_u(t.nv()),
        forces(t.nv()),
        inertia(t.nv(), t.nv()) {}

  const Tree& tree;
  id::MultiBodyTree bodies;
  id::vecx q, u, dot_u, forces;
  id::matxx inertia;
  Matrix3d R_WB = Matrix3d::Identity();

  // Converts the rows of a floating base from the base's axes, which Bullet
  // uses, to the world's axes.
  MatrixXd ToOurAxes(MatrixXd rows) const {
    if (tree.is_floating()) {
      rows.topRows<3>() = (R_WB * rows.topRows<3>()).eval();
      rows.middleRows<3>(3) = (R_WB * rows.middleRows<3>(3)).eval();
    }
    return rows;
  }
};

bool BulletTree::IsHere() { return true; }

BulletTree::BulletTree(const Tree& tree)
    : bullet_(std::make_unique<Bullet>(tree)) {
  id::MultiBodyTree& bodies = bullet_->bodies;
  bodies.setAcceptInvalidMassParameters(true);  // Massless links.
  for (int b = 0; b < tree.num_bodies(); ++b) {
    Joint joint{"", JointType::kFixed, -1, Pose(), Vector3d::UnitX(), 0};
    if (b > 0) joint = tree.joints()[b - 1];
    id::JointType type = id::REVOLUTE;
    if (b == 0) type = tree.is_floating() ? id::FLOATING : id::FIXED;
    if (joint.type == JointType::kPrismatic) type = id::PRISMATIC;
    const Inertia& M = tree.inertias()[b];
    const Vector3d& p = M.p_BoG_B;
    const Matrix3d I_Bo =
        M.I_G_B +
        M.mass * (p.squaredNorm() * Matrix3d::Identity() - p * p.transpose());
    Check(bodies.addBody(b, joint.parent, type, ToBullet(joint.X_PF.p),
                         ToBullet(Matrix3d(joint.X_PF.R.transpose())),
                         ToBullet(joint.axis_F), M.mass, ToBullet(p),
                         ToBullet(I_Bo), 0, nullptr),
          "addBody");
  }
  Check(bodies.finalize(), "finalize");
  Check(bodies.setGravityInWorldFrame(ToBullet(tree.gravity_W())),
        "setGravityInWorldFrame");
}

BulletTree::~BulletTree() = default;

void BulletTree::Set(const VectorXd& q, const VectorXd& v, const VectorXd& vdot,
                     const std::vector<SpatialForce>& F_Bo_W) {
  Bullet& b = *bullet_;
  const Tree& tree = b.tree;
  if (tree.is_floating()) {
    const Eigen::Quaterniond quaternion(q[6], q[3], q[4], q[5]);
    b.R_WB = quaternion.normalized().toRotationMatrix();
    const Vector3d angles = b.R_WB.eulerAngles(0, 1, 2);
    const Matrix3d R_BW = b.R_WB.transpose();
    const Vector3d w = R_BW * v.head<3>(), v_B = R_BW * v.segment<3>(3);
    const Vector3d alpha = R_BW * vdot.head<3>();
    const Vector3d a_B = R_BW * vdot.segment<3>(3);
    for (int i = 0; i < 3; ++i) {
      b.q[i] = angles[i], b.q[i + 3] = q[i];
      b.u[i] = w[i], b.u[i + 3] = v_B[i];
      b.dot_u[i] = alpha[i], b.dot_u[i + 3] = a_B[i];
    }
  }
  for (int j = tree.v_start(); j < tree.nv(); ++j) {
    b.q[j] = q[j - tree.v_start() + tree.q_start()];
    b.u[j] = v[j];
    b.dot_u[j] = vdot[j];
  }
  b.bodies.clearAllUserForcesAndMoments();
  if (F_Bo_W.empty()) return;
  std::vector<Pose> X_WB(tree.num_bodies());
  ComputePoses(tree, q, &X_WB);
  for (int k = 0; k < tree.num_bodies(); ++k) {
    const Matrix3d R_BW = X_WB[k].R.transpose();
    const SpatialForce F_Bo_B = R_BW * F_Bo_W[k];
    Check(b.bodies.addUserForce(k, ToBullet(F_Bo_B.linear)), "addUserForce");
    Check(b.bodies.addUserMoment(k, ToBullet(F_Bo_B.angular)), "addUserMoment");
  }
}

void BulletTree::ComputeInverseDynamics() {
  Bullet& b = *bullet_;
  Check(b.bodies.calculateInverseDynamics(b.q, b.u, b.dot_u, &b.forces),
        "calculateInverseDynamics");
}

void BulletTree::ComputeMassMatrix() {
  Check(bullet_->bodies.calculateMassMatrix(bullet_->q, &bullet_->inertia),
        "calculateMassMatrix");
}

VectorXd BulletTree::tau() const {
  const Bullet& b = *bullet_;
  VectorXd tau(b.tree.nv());
  for (int i = 0; i < tau.size(); ++i) tau[i] = b.forces[i];
  return b.ToOurAxes(tau);
}

MatrixXd BulletTree::M() const {
  const Bullet& b = *bullet_;
  const int n = b.tree.nv();
  MatrixXd M(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) M(i, j) = b.inertia(i, j);
  }
  return b.ToOurAxes(b.ToOurAxes(M).transpose());
}

}  // namespace poise

#else

namespace poise {

struct BulletTree::Bullet {};

bool BulletTree::IsHere() { return false; }

BulletTree::BulletTree(const Tree&) {
  throw std::runtime_error("libbullet-extras-dev is not installed");
}
BulletTree::~BulletTree() = default;

// These are never called, because the constructor throws.
void BulletTree::Set(const Eigen::VectorXd&, const Eigen::VectorXd&,
                     const Eigen::VectorXd&, const std::vector<SpatialForce>&) {
}
void BulletTree::ComputeInverseDynamics() {}
void BulletTree::ComputeMassMatrix() {}
Eigen::VectorXd BulletTree::tau() const { return {}; }
Eigen::MatrixXd BulletTree::M() const { return {}; }

}  // namespace poise

#endif
