// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The dynamics of an arm on a table, from its URDF file: the torques of a
// motion by RNEA, and the motion of these torques by ABA.
#include <iostream>

#include "poise/dynamics/aba.h"
#include "poise/dynamics/rnea.h"
#include "poise/robot/urdf/urdf.h"

int main(int argc, char** argv) {
  const std::string file = argc > 1 ? argv[1] : "arm.urdf";
  const poise::Tree tree =
      poise::LoadUrdf(file).tree.WithBase(poise::BaseType::kFixed);
  const int n = tree.num_joints();
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(n, 0.5);  // rad
  const Eigen::VectorXd v = Eigen::VectorXd::Zero(n);           // rad/s
  const Eigen::VectorXd vdot = Eigen::VectorXd::Ones(n);        // rad/s2
  Eigen::VectorXd tau(n), again(n);                             // N m, rad/s2

  poise::Recursion scratch(tree);  // All memory is allocated here.
  poise::ComputeRnea(tree, q, v, vdot, {}, &scratch, tau);
  for (int j = 0; j < n; ++j) {
    std::cout << tree.joints()[j].name << ": " << tau[j] << " N m\n";
  }

  poise::AbaScratch aba(tree);
  if (poise::ComputeAba(tree, q, v, tau, {}, &aba, again) !=
      poise::AbaStatus::kOk) {
    return 1;
  }
  return (again - vdot).norm() < 1e-9 ? 0 : 2;
}
