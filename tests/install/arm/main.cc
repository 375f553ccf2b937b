// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <iostream>

#include "poise/dynamics/rnea.h"
#include "poise/robot/urdf/urdf.h"

int main(int, char** argv) {
  const poise::Tree tree = poise::LoadUrdf(argv[1]).tree;
  const Eigen::VectorXd q = tree.MakeNeutral();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(tree.nv());
  Eigen::VectorXd tau = zero;
  poise::Recursion scratch(tree);
  poise::ComputeRnea(tree, q, zero, zero, {}, &scratch, tau);
  std::cout << "the table holds " << tau[5] << " N\n";
}
