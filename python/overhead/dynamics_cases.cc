// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <Eigen/Core>
#include <memory>

#include "poise/dynamics/aba.h"
#include "poise/dynamics/center_of_mass.h"
#include "poise/dynamics/centroidal.h"
#include "poise/dynamics/crba.h"
#include "poise/dynamics/derivatives.h"
#include "poise/dynamics/energy.h"
#include "poise/dynamics/integrate.h"
#include "poise/dynamics/jacobian.h"
#include "poise/dynamics/kinematics.h"
#include "poise/dynamics/recursion.h"
#include "poise/dynamics/regressor.h"
#include "poise/dynamics/rnea.h"
#include "poise/dynamics/tick.h"
#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"
#include "poise/math/spatial.h"
#include "poise/python/overhead/cases.h"

namespace poise {
namespace {

// The arguments of all calls, and memory for their results, allocated once as
// in a control loop. measure.py has the same arguments.
struct Work {
  explicit Work(const Robot& robot)
      : tree(robot.model.tree),
        q(tree.nq()),
        v(Eigen::VectorXd::LinSpaced(tree.nv(), -1, 1)),
        vdot(-v),
        vector(tree.nv()),
        q_out(tree.nq()),
        matrix(tree.nv(), tree.nv()),
        jacobian(6, tree.nv()),
        Y(tree.nv(), 10 * tree.num_bodies() + tree.num_joints()),
        X_WB(tree.num_bodies()),
        V_WB_W(tree.num_bodies()),
        A_WB_W(tree.num_bodies()),
        recursion(tree),
        aba(tree),
        com(tree),
        momentum(tree),
        derivatives(tree),
        tick(tree, {robot.feet[0].frame, robot.feet[1].frame}),
        frame(robot.feet[0].frame) {
    Integrate(tree, robot.q_nominal, v, 0.3, q);
  }

  const Tree& tree;
  Eigen::VectorXd q, v, vdot, vector, q_out;
  Eigen::MatrixXd matrix;
  Matrix6Xd jacobian;
  Eigen::MatrixXd Y;
  std::vector<Pose> X_WB;
  std::vector<SpatialMotion> V_WB_W;
  std::vector<SpatialAcceleration> A_WB_W;
  Recursion recursion;
  AbaScratch aba;
  CenterOfMass com;
  CentroidalMomentum momentum;
  RneaDerivatives derivatives;
  Tick tick;
  int frame;
};

using Shared = std::shared_ptr<Work>;

void AddEquationOfMotion(const Shared& w, std::vector<TimedCase>* cases) {
  cases->push_back({"Tree.rnea", [w] {
                      ComputeRnea(w->tree, w->q, w->v, w->vdot, {},
                                  &w->recursion, w->vector);
                    }});
  cases->push_back(
      {"Tree.bias",
       [w] { ComputeBias(w->tree, w->q, w->v, &w->recursion, w->vector); }});
  cases->push_back({"Tree.crba", [w] {
                      ComputeCrba(w->tree, w->q, &w->recursion, w->matrix);
                    }});
  cases->push_back(
      {"Tree.aba", [w] {
         Keep(ComputeAba(w->tree, w->q, w->v, w->vdot, {}, &w->aba, w->vector));
       }});
}

void AddKinematics(const Shared& w, std::vector<TimedCase>* cases) {
  cases->push_back({"Tree.pose", [w] {
                      ComputePoses(w->tree, w->q, &w->X_WB);
                      Keep(FramePose(w->tree, w->X_WB, w->frame));
                    }});
  cases->push_back({"Tree.jacobian", [w] {
                      ComputePoses(w->tree, w->q, &w->X_WB);
                      ComputeFrameJacobian(w->tree, w->X_WB, w->frame,
                                           Axes::kWorld, w->jacobian);
                    }});
  cases->push_back(
      {"Tree.jacobian_bias", [w] {
         const Tree& tree = w->tree;
         ComputePoses(tree, w->q, &w->X_WB);
         ComputeVelocities(tree, w->X_WB, w->v, &w->V_WB_W);
         ComputeAccelerations(tree, w->X_WB, w->V_WB_W, w->v,
                              Eigen::VectorXd::Zero(tree.nv()), &w->A_WB_W);
         Keep(FrameBias(
             FrameAcceleration(tree, w->X_WB, w->V_WB_W, w->A_WB_W, w->frame),
             FrameVelocity(tree, w->X_WB, w->V_WB_W, w->frame),
             FramePose(tree, w->X_WB, w->frame).R, Axes::kWorld));
       }});
  cases->push_back({"Tree.integrate",
                    [w] { Integrate(w->tree, w->q, w->v, 0.1, w->q_out); }});
  cases->push_back(
      {"Tree.difference", [w] { Difference(w->tree, w->q, w->q, w->vector); }});
}

void AddMomentum(const Shared& w, std::vector<TimedCase>* cases) {
  cases->push_back({"Tree.com", [w] {
                      ComputeCenterOfMass(w->tree, w->q, w->v, &w->recursion,
                                          &w->com);
                    }});
  cases->push_back({"Tree.centroidal", [w] {
                      ComputeCentroidalMomentum(w->tree, w->q, w->v,
                                                &w->recursion, &w->momentum);
                    }});
  cases->push_back({"Tree.kinetic_energy", [w] {
                      ComputePoses(w->tree, w->q, &w->X_WB);
                      ComputeVelocities(w->tree, w->X_WB, w->v, &w->V_WB_W);
                      Keep(KineticEnergy(w->tree, w->X_WB, w->V_WB_W, w->v));
                    }});
  cases->push_back({"Tree.potential_energy", [w] {
                      ComputePoses(w->tree, w->q, &w->X_WB);
                      Keep(PotentialEnergy(w->tree, w->X_WB));
                    }});
}

void AddModel(const Shared& w, std::vector<TimedCase>* cases) {
  cases->push_back({"Tree.derivatives", [w] {
                      ComputeRneaDerivatives(w->tree, w->q, w->v, w->vdot, {},
                                             &w->derivatives);
                    }});
  cases->push_back({"Tree.regressor", [w] {
                      ComputeRegressor(w->tree, w->q, w->v, w->vdot,
                                       &w->recursion, w->Y);
                    }});
  cases->push_back({"Tree.inertial_parameters",
                    [w] { Keep(MakeInertialParameters(w->tree)); }});
  cases->push_back({"Tree.neutral", [w] { Keep(w->tree.MakeNeutral()); }});
  cases->push_back(
      {"Tree.tick", [w] { ComputeTick(w->tree, w->q, w->v, &w->tick); }});
}

}  // namespace

void AddDynamicsCases(const Robot& robot, std::vector<TimedCase>* cases) {
  const auto work = std::make_shared<Work>(robot);
  AddEquationOfMotion(work, cases);
  AddKinematics(work, cases);
  AddMomentum(work, cases);
  AddModel(work, cases);
}

}  // namespace poise
