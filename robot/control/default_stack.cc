// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/default_stack.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "poise/dynamics/tree.h"
#include "poise/robot/control/tasks/angular_momentum.h"
#include "poise/robot/control/tasks/capture_point.h"
#include "poise/robot/control/tasks/com.h"
#include "poise/robot/control/tasks/contact.h"
#include "poise/robot/control/tasks/cop.h"
#include "poise/robot/control/tasks/force_regularizer.h"
#include "poise/robot/control/tasks/frame.h"
#include "poise/robot/control/tasks/friction.h"
#include "poise/robot/control/tasks/froude.h"
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

// Gain that keeps the base upright, over weight * Y^2 / h, with Y half the
// width of a sole and h the height of the center of mass above the soles. On
// one foot the CoP moves by at most Y, and the lean that it can correct is Y /
// h. The value gives 200 N m/rad for robot/models/humanoid.urdf.
constexpr double kOrientation = 98.8;
constexpr double kMostOrientation = 1e6;  // The parameter's bound, N m/rad.

// The size of a robot that stands on its soles, m.
struct Size {
  double com_height;  // Height of the center of mass above the soles.
  double half_width;  // Half the width of the narrower sole.
};

// Returns nothing if the robot has no feet or no posture in which it stands.
std::optional<Size> SizeOf(const Robot& robot) {
  const std::optional<double> h = NominalComHeight(robot);
  double Y = std::numeric_limits<double>::infinity();
  for (const Foot& foot : robot.feet) Y = std::min(Y, foot.half_size.y());
  // A posture that does not stand may have its center of mass below the soles.
  if (!h || !(*h > Y)) return std::nullopt;
  return Size{*h, Y};
}

// Returns k_orientation, N m/rad, with three significant digits.
double OrientationGain(const Tree& tree, const Size& size, double otherwise) {
  const double weight = tree.total_mass() * tree.gravity_W().norm();
  const double k =
      std::min(kMostOrientation, kOrientation * weight * size.half_width *
                                     size.half_width / size.com_height);
  if (!(k > 0)) return otherwise;
  const double digits = std::pow(10, 2 - std::floor(std::log10(k)));
  return std::round(k * digits) / digits;
}

// Fits the defaults to the robot: they hold for one of kTunedComHeight.
void FitToRobot(const Robot& robot, Stack* stack) {
  const std::optional<Size> size = SizeOf(robot);
  if (!size) return;
  for (int i = 0; i < stack->num_tasks(); ++i) {
    ScaleToHeight(size->com_height, stack->task(i));
  }
  const double standard =
      stack->GetParameter("momentum", "k_orientation").value_or(0);
  (void)stack->SetParameter("momentum", "k_orientation",
                            OrientationGain(robot.model.tree, *size, standard));
}

}  // namespace

Stack MakeDefaultStack(const Robot& robot,
                       const std::vector<std::string>& frames) {
  const RobotModel& model = robot.model;
  const Tree& tree = model.tree;
  const std::vector<Foot>& feet = robot.feet;
  const FroudeScale scale = MakeFroudeScale(robot);
  Stack stack(tree.nv() + 6 * static_cast<int>(feet.size()));

  stack.Add(std::make_unique<NewtonEulerTask>(tree), {kOn, 1, 1});
  stack.Add(std::make_unique<NoContactTask>(tree, feet), {kOn, 1, 1});

  stack.Add(std::make_unique<TorqueLimitsTask>(model), {kOn, 2, 1});
  stack.Add(std::make_unique<JointLimitsTask>(model, feet, scale), {kOn, 2, 1});

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
  // The last task of its level: its rows are added and removed, and the solver
  // starts from the working set of the last tick by index.
  stack.Add(std::make_unique<SelfCollisionTask>(robot), {kOn, 3, 1});

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

  stack.Add(std::make_unique<PostureTask>(model, scale), {kOn, 5, 1});
  stack.Add(std::make_unique<ForceRegularizerTask>(tree, feet, scale),
            {kOn, 5, kRegularizerWeight});
  stack.Add(std::make_unique<TorqueMinimizationTask>(model), {kOff, 5, 1});
  FitToRobot(robot, &stack);
  return stack;
}

}  // namespace poise
