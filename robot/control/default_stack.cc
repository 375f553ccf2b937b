// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/default_stack.h"

#include <memory>

#include "poise/robot/control/tasks/angular_momentum.h"
#include "poise/robot/control/tasks/capture_point.h"
#include "poise/robot/control/tasks/com.h"
#include "poise/robot/control/tasks/contact.h"
#include "poise/robot/control/tasks/cop.h"
#include "poise/robot/control/tasks/force_regularizer.h"
#include "poise/robot/control/tasks/frame.h"
#include "poise/robot/control/tasks/friction.h"
#include "poise/robot/control/tasks/joint_limits.h"
#include "poise/robot/control/tasks/light_joints.h"
#include "poise/robot/control/tasks/linear_momentum.h"
#include "poise/robot/control/tasks/mimic.h"
#include "poise/robot/control/tasks/momentum.h"
#include "poise/robot/control/tasks/newton_euler.h"
#include "poise/robot/control/tasks/no_contact.h"
#include "poise/robot/control/tasks/posture.h"
#include "poise/robot/control/tasks/self_collision.h"
#include "poise/robot/control/tasks/swing.h"
#include "poise/robot/control/tasks/torque_limits.h"
#include "poise/robot/control/tasks/torque_minimization.h"
#include "poise/robot/control/tasks/unilateral.h"
#include "poise/robot/control/tasks/yaw.h"
#include "poise/robot/control/tasks/yaw_constant.h"
#include "poise/robot/control/tasks/zmp.h"
#include "poise/robot/control/tasks/zmp_literal.h"

namespace poise {
namespace {

constexpr bool kOn = true;
constexpr bool kOff = false;

// Momentum and posture do not determine the internal forces: the regularizer
// does. The small weight keeps it from competing with the posture on its level.
constexpr double kRegularizerWeight = 1e-2;

}  // namespace

Stack MakeDefaultStack(const Robot& robot,
                       const std::vector<std::string>& frames) {
  const RobotModel& model = robot.model;
  const Tree& tree = model.tree;
  const std::vector<Foot>& feet = robot.feet;
  Stack stack(tree.nv() + 6 * static_cast<int>(feet.size()));

  stack.Add(std::make_unique<NewtonEulerTask>(tree), {kOn, 1, 1});
  stack.Add(std::make_unique<NoContactTask>(tree, feet), {kOn, 1, 1});

  stack.Add(std::make_unique<TorqueLimitsTask>(model), {kOn, 2, 1});
  stack.Add(std::make_unique<JointLimitsTask>(model), {kOn, 2, 1});
  stack.Add(std::make_unique<SelfCollisionTask>(robot), {kOn, 2, 1});

  if (!model.mimics.empty()) {
    stack.Add(std::make_unique<MimicTask>(model), {kOn, 3, 1});
  }
  if (!FindLightJoints(model).empty()) {
    stack.Add(std::make_unique<LightJointsTask>(model), {kOn, 3, 1});
  }
  stack.Add(std::make_unique<ContactTask>(model, feet), {kOn, 3, 1});
  stack.Add(std::make_unique<CopTask>(tree, feet), {kOn, 3, 1});
  stack.Add(std::make_unique<FrictionTask>(tree, feet), {kOn, 3, 1});
  stack.Add(std::make_unique<UnilateralTask>(tree, feet), {kOn, 3, 1});
  stack.Add(std::make_unique<YawTask>(tree, feet), {kOn, 3, 1});
  stack.Add(std::make_unique<YawConstantTask>(tree, feet), {kOff, 3, 1});
  stack.Add(std::make_unique<ZmpTask>(tree, feet), {kOff, 3, 1});
  stack.Add(std::make_unique<ZmpLiteralTask>(tree, feet), {kOff, 3, 1});

  stack.Add(std::make_unique<CapturePointTask>(tree, feet), {kOff, 3, 1});

  stack.Add(std::make_unique<MomentumTask>(tree, feet), {kOn, 4, 1});
  stack.Add(std::make_unique<ComTask>(tree), {kOff, 4, 1});
  stack.Add(std::make_unique<LinearMomentumTask>(tree), {kOff, 4, 1});
  stack.Add(std::make_unique<AngularMomentumTask>(tree), {kOff, 4, 1});
  for (int i = 0; i < static_cast<int>(feet.size()); ++i) {
    stack.Add(std::make_unique<SwingTask>(feet[i], i), {kOn, 4, 1});
  }
  for (int i = 0; i < static_cast<int>(frames.size()); ++i) {
    const int tick_frame = static_cast<int>(feet.size()) + i;
    stack.Add(std::make_unique<FrameTask>(frames[i], tick_frame, i),
              {kOff, 4, 1});
  }

  stack.Add(std::make_unique<PostureTask>(tree), {kOn, 5, 1});
  stack.Add(std::make_unique<ForceRegularizerTask>(tree, feet),
            {kOn, 5, kRegularizerWeight});
  stack.Add(std::make_unique<TorqueMinimizationTask>(model), {kOff, 5, 1});
  return stack;
}

}  // namespace poise
