// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The dynamics of an arm from its URDF file: the torques of a motion by RNEA, the
// motion of these torques by ABA.
#include <iostream>

#include "poise/dynamics/aba.h"
#include "poise/dynamics/rnea.h"
#include "poise/robot/urdf/urdf.h"

int main(int argc, char** argv) {
  const std::string file = argc > 1 ? argv[1] : "arm.urdf";
  const poise::Tree tree = poise::LoadUrdf(file).tree;
  Eigen::VectorXd q = tree.MakeNeutral();
  q.tail(tree.num_joints()).setConstant(0.5);                  // rad
  const Eigen::VectorXd v = Eigen::VectorXd::Zero(tree.nv());  // rad/s
  Eigen::VectorXd vdot = v, again = v, tau = v;                // rad/s2, N m
  vdot.tail(tree.num_joints()).setConstant(1);

  poise::Recursion scratch(tree);  // All memory is allocated here.
  poise::ComputeRnea(tree, q, v, vdot, {}, &scratch, tau);
  for (int j = 0; j < tree.num_joints(); ++j) {
    std::cout << tree.joints()[j].name << ": " << tau[tree.v_start() + j]
              << " N m\n";
  }
  // Entries 0 to 5 hold the root link: a moment and a force.
  std::cout << "the table holds " << tau[5] << " N\n";

  poise::AbaScratch aba(tree);
  if (poise::ComputeAba(tree, q, v, tau, {}, &aba, again) !=
      poise::AbaStatus::kOk) {
    return 1;
  }
  return (again - vdot).norm() < 1e-9 ? 0 : 2;
}
