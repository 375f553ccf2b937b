// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// A robot's own program: state in, torques out, no simulator.
#include <iostream>
#include <string>

#include "poise/dynamics/tree.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/task_set.h"
#include "poise/robot/profile/profile.h"

// A placeholder: read the robot's encoders, gyroscope and base estimate here.
poise::State ReadSensors(const poise::Robot& robot, double time) {
  return {time, robot.q_nominal, Eigen::VectorXd::Zero(robot.model.tree.nv())};
}

int main(int argc, char** argv) {
  const std::string urdf = argc > 1 ? argv[1] : "robot/models/humanoid.urdf";
  const std::string yaml = argc > 2 ? argv[2] : "robot/profiles/humanoid.yaml";
  const poise::Profile profile = poise::LoadProfile(yaml);
  const poise::Robot robot = poise::LoadRobot(urdf, profile);

  poise::Controller controller(robot);  // All memory is allocated here.
  if (profile.tasks.IsDefined()) {
    poise::ApplyTasks(profile.tasks, yaml, &controller.stack());
  }
  controller.Start(ReadSensors(robot, 0));
  controller.reference().p_WG.z() -= 0.01;  // Lower the center of mass by 1 cm.

  poise::Command command;
  command.tau.setZero(robot.model.tree.num_joints());
  for (int tick = 1; tick <= 10; ++tick) {  // One tick per millisecond.
    controller.Update(ReadSensors(robot, 1e-3 * tick), &command);
    if (command.status != poise::TickStatus::kOk) return 1;
  }
  const int knee = *robot.model.tree.FindJoint("l_knee");
  std::cout << "torque of the left knee: " << command.tau[knee] << " N m\n";
  return command.tau.allFinite() ? 0 : 1;
}
