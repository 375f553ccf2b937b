// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Writes a robot's tree for compare:
//   record_tree ROBOT FILE
// ROBOT is a URDF file, or a number: our humanoid with so many more fingers on
// each hand, of five joints each.
#include <exception>
#include <iostream>
#include <string>

#include "poise/robot/urdf/urdf.h"
#include "poise/tests/peers/tree_file.h"
#include "poise/tests/util/added_fingers.h"

namespace {

bool IsNumber(const std::string& text) {
  return !text.empty() &&
         text.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "record_tree: " << argc - 1
              << " arguments, want 2: ROBOT FILE\n";
    return 2;
  }
  try {
    const std::string robot = argv[1];
    const poise::RobotModel model =
        IsNumber(robot) ? poise::AddFingers(std::stoi(robot)).MakeModel()
                        : poise::LoadUrdf(robot);
    poise::WriteTree(model.tree, argv[2]);
  } catch (const std::exception& error) {
    std::cerr << "record_tree: " << error.what() << "\n";
    return 2;
  }
}
