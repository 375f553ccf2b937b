// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// A double pendulum and a chain that floats: what the dynamics do by themselves.

#include <cstdio>
#include <string>

#include "dynamics/aba.h"
#include "dynamics/centroidal.h"
#include "dynamics/energy.h"
#include "dynamics/integrate.h"
#include "dynamics/kinematics.h"

// Rods of 1 kg and 0.5 m, each hinged to the one before.
poise::Tree MakeChain(int rods, poise::BaseType base) {
  poise::Inertia rod{1, {0.25, 0, 0}, Eigen::Matrix3d::Identity() / 48};
  poise::TreeBuilder builder;
  builder.AddLink("rod0", rod);
  for (int i = 1; i < rods; ++i) {
    builder.AddLink("rod" + std::to_string(i), rod);
    poise::JointSpec hinge;
    hinge.name = "hinge" + std::to_string(i);
    hinge.type = poise::JointType::kRevolute;
    hinge.parent = "rod" + std::to_string(i - 1);
    hinge.child = "rod" + std::to_string(i);
    hinge.X_PF.p.x() = 0.5;
    hinge.axis_F = i % 2 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
    if (base == poise::BaseType::kFixed) hinge.axis_F.setUnit(1);
    builder.AddJoint(hinge);
  }
  return builder.Build(base);
}

// Two seconds of gravity alone, by the midpoint rule: the energy stays.
void Simulate(const char* name, const poise::Tree& tree, double rate) {
  const double dt = 1e-3;
  Eigen::VectorXd q = tree.MakeNeutral(), q_mid = q;
  Eigen::VectorXd v = Eigen::VectorXd::Constant(tree.nv(), rate), vdot = v;
  const Eigen::VectorXd tau = Eigen::VectorXd::Zero(tree.nv());
  poise::AbaScratch scratch(tree);
  std::vector<poise::Pose> X_WB(tree.num_bodies());
  std::vector<poise::Vector6d> V_WB_W(tree.num_bodies());
  for (int step = 0; step <= 2000; ++step) {
    if (step % 500 == 0) {
      poise::ComputePoses(tree, q, &X_WB);
      poise::ComputeVelocities(tree, X_WB, v, &V_WB_W);
      const double energy = poise::KineticEnergy(tree, X_WB, V_WB_W, v) +
                            poise::PotentialEnergy(tree, X_WB);
      const Eigen::Vector3d G = poise::CompositeInertia(tree, X_WB).p_BoG_B;
      std::printf("%s  t %.1f s  center of mass %7.3f %7.3f %7.3f  E %.4f J\n",
                  name, step * dt, G.x(), G.y(), G.z(), energy);
    }
    (void)poise::ComputeAba(tree, q, v, tau, {}, &scratch, vdot);
    const Eigen::VectorXd v_mid = v + dt / 2 * vdot;
    poise::Integrate(tree, q, v, dt / 2, q_mid);
    (void)poise::ComputeAba(tree, q_mid, v_mid, tau, {}, &scratch, vdot);
    poise::Integrate(tree, q, v_mid, dt, q);
    v += dt * vdot;
  }
}

int main() {
  Simulate("double pendulum", MakeChain(3, poise::BaseType::kFixed), 0);
  Simulate("floating chain ", MakeChain(5, poise::BaseType::kFloating), 1);
}
