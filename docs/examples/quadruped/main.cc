// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// A quadruped of 15 kg: standing torques, and its momentum in motion.
#include <cstdio>
#include <string>

#include "poise/dynamics/tick.h"

int main() {
  Eigen::Vector3d trunk(0.1, 0.3, 0.3), rod(2e-3, 2e-3, 1e-4);  // kg m2.
  poise::TreeBuilder builder;
  builder.AddLink("trunk", {9, {0, 0, 0}, trunk.asDiagonal()});
  for (const std::string leg : {"lf", "rf", "lh", "rh"}) {
    std::string parent = "trunk";
    poise::Pose X_PF;
    X_PF.p << (leg[1] == 'f' ? 0.2 : -0.2), (leg[0] == 'l' ? 0.1 : -0.1), 0;
    for (const std::string part : {"_hip", "_thigh", "_shank"}) {
      const int axis = part == "_hip" ? 0 : 1;  // The hip turns about x.
      builder.AddLink(leg + part, {0.5, {0, 0, -0.1}, rod.asDiagonal()});
      builder.AddJoint({leg + part, poise::JointType::kRevolute, parent,
                        leg + part, X_PF, Eigen::Vector3d::Unit(axis)});
      parent = leg + part;
      X_PF.p << 0, 0, -0.2 * axis;
    }
    builder.AddLink(leg);  // The foot.
    builder.AddJoint({leg, poise::JointType::kFixed, parent, leg, X_PF});
  }
  const poise::Tree tree = builder.Build();
  Eigen::VectorXd q = tree.MakeNeutral(), v = Eigen::VectorXd::Zero(tree.nv());
  q.tail(12) << 0, .7, -1.4, 0, .7, -1.4, 0, -.7, 1.4, 0, -.7, 1.4;  // rad.
  v[2] = 1, v[3] = 0.5;  // Turns left, rad/s, and moves forward, m/s.
  const auto at = [&tree](const char* name) { return *tree.FindFrame(name); };
  poise::Tick tick(tree, {at("lf"), at("rf"), at("lh"), at("rh")});
  poise::ComputeTick(tree, q, v, &tick);
  const Eigen::VectorXd weight = tick.N - tick.c, V = tick.frames[0].V_WF_W;
  Eigen::VectorXd tau = weight;  // A foot carries a quarter: tau = g - J'f.
  for (auto& f : tick.frames) tau -= f.J_WF_W.row(5) * weight[5] / 4;
  std::printf("weight %.3f N, base %.3f N, ", weight[5], tau.head(6).norm());
  std::printf("knee %.4f N m, foot %.3f %.3f m/s, L %.4f %.3f, M %.4f kg m2\n",
              tau[8], V[3], V[4], tick.L_G[2], tick.L_G[3], tick.M(2, 2));
}
