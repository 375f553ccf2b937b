// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// A double pendulum and a chain that floats: what the dynamics do by
// themselves.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "poise/dynamics/aba.h"
#include "poise/dynamics/energy.h"
#include "poise/dynamics/integrate.h"
#include "poise/dynamics/tick.h"

using namespace poise;

// Bars of 1 kg and 0.5 m x 0.1 m x 0.04 m, each hinged to the one before.
Tree MakeChain(int bars, BaseType base) {
  const Eigen::Vector3d moments(0.00097, 0.02097, 0.02167);
  const Inertia bar{1, {0.25, 0.02, -0.01}, moments.asDiagonal()};
  TreeBuilder builder;
  builder.AddLink("bar0", bar);
  for (int i = 1; i < bars; ++i) {
    const std::string parent = std::to_string(i - 1), n = std::to_string(i);
    const Pose X_PF{Eigen::Matrix3d::Identity(), {0.5, 0, 0}};
    const Eigen::Vector3d axis(0, 1, base == BaseType::kFixed ? 0 : i % 3 - 1);
    builder.AddLink("bar" + n, bar);
    builder.AddJoint({"hinge" + n, JointType::kRevolute, "bar" + parent,
                      "bar" + n, X_PF, axis});
  }
  return builder.Build(base);
}

// Two seconds of gravity alone, by the midpoint rule: the energy stays.
void Simulate(const char* name, const Tree& tree, double rate) {
  const double dt = 5e-4;
  Eigen::VectorXd q = tree.MakeNeutral(), q_mid = q;
  Eigen::VectorXd v = Eigen::VectorXd::Constant(tree.nv(), rate), v_mid = v;
  Eigen::VectorXd vdot = v, tau = 0 * v;
  AbaScratch scratch(tree);
  Tick now(tree, {});
  for (int step = 0; step <= 4000; ++step) {
    if (step % 1000 == 0) {
      ComputeTick(tree, q, v, &now);
      const double E = v.dot(now.M * v) / 2 + PotentialEnergy(tree, now.X_WB);
      std::printf("%s  t %.1f s  center of mass %7.3f %7.3f %7.3f  E %.4f J\n",
                  name, step * dt, now.p_WG.x(), now.p_WG.y(), now.p_WG.z(), E);
    }
    AbaStatus status = ComputeAba(tree, q, v, tau, {}, &scratch, vdot);
    if (status != AbaStatus::kOk) std::exit(1);
    v_mid = v + dt / 2 * vdot;
    Integrate(tree, q, v, dt / 2, q_mid);
    status = ComputeAba(tree, q_mid, v_mid, tau, {}, &scratch, vdot);
    if (status != AbaStatus::kOk) std::exit(1);
    Integrate(tree, q, v_mid, dt, q);
    v += dt * vdot;
  }
}

int main() {
  Simulate("double pendulum", MakeChain(3, BaseType::kFixed), 0);
  Simulate("floating chain ", MakeChain(5, BaseType::kFloating), 1);
}
