// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The adapter of TSID: one weighted level with eiquadprog-fast.
#include <algorithm>
#include <cmath>
#include <memory>
#include <pinocchio/multibody/data.hpp>
#include <pinocchio/multibody/model.hpp>
#include <tsid/contacts/contact-6d.hpp>
#include <tsid/formulations/inverse-dynamics-formulation-acc-force.hpp>
#include <tsid/robots/robot-wrapper.hpp>
#include <tsid/solvers/solver-HQP-eiquadprog-fast.hpp>
#include <tsid/tasks/task-actuation-bounds.hpp>
#include <tsid/tasks/task-angular-momentum-equality.hpp>
#include <tsid/tasks/task-com-equality.hpp>
#include <tsid/tasks/task-joint-bounds.hpp>
#include <tsid/tasks/task-joint-posture.hpp>
#include <vector>

#include "poise/dynamics/conventions.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/limits.h"
#include "poise/tests/peers/peer_controller.h"
#include "poise/tests/peers/pinocchio_model.h"

namespace poise {
namespace {

using Eigen::VectorXd;

// The weights, and the gain of contacts, center of mass and momentum, are those
// of TSID's example of a biped, exercizes/talos_conf.py. The posture has the
// same gain here.
constexpr double kComWeight = 1, kMomentumWeight = 1e-3, kPostureWeight = 0.1,
                 kForceWeight = 1e-5;
constexpr double kGain = 10;

// Bounds of the normal force of a foot: the lower one in N, the upper one in
// weights of the robot. No tick reaches the upper one.
constexpr double kLeastForce = 5, kMostWeights = 10;

// Levels of the formulation: the constraints, and the one weighted level.
constexpr unsigned kConstraints = 0, kTasks = 1;

// Returns the contact frames of the feet, each with the name of its foot.
std::vector<Frame> ContactFrames(const Robot& robot) {
  std::vector<Frame> frames;
  for (const Foot& foot : robot.feet) {
    frames.push_back({foot.name, foot.body, foot.X_BC});
  }
  return frames;
}

// Returns the corners of the sole in its contact frame.
Eigen::Matrix<double, 3, 4> Corners(const Foot& foot) {
  const double x = foot.half_size.x(), y = foot.half_size.y();
  Eigen::Matrix<double, 3, 4> corners;
  corners << -x, -x, x, x,  //
      -y, y, -y, y,         //
      0, 0, 0, 0;
  return corners;
}

// Sets the gains of a critically damped task.
template <typename Task>
void SetGains(int size, Task* task) {
  task->Kp(VectorXd::Constant(size, kGain));
  task->Kd(VectorXd::Constant(size, 2 * std::sqrt(kGain)));
}

class TsidPeer final : public PeerController {
 public:
  explicit TsidPeer(const ControllerSetup& setup)
      : tree_(setup.robot.model.tree),
        wrapper_(MakePinocchioModel(tree_, ContactFrames(setup.robot)),
                 tsid::robots::RobotWrapper::FLOATING_BASE_SYSTEM),
        formulation_("tsid", wrapper_),
        com_("com", wrapper_),
        momentum_("momentum", wrapper_),
        posture_("posture", wrapper_),
        torque_bounds_("torque bounds", wrapper_),
        velocity_bounds_("velocity bounds", wrapper_, ControllerOptions().dt),
        solver_("eiquadprog"),
        q_(wrapper_.nq()),
        v_(wrapper_.nv()) {
    Load(setup.start);
    formulation_.computeProblemData(state_.time, q_, v_);
    AddContacts(setup.robot);
    AddTasks();
    if (setup.has_limits) AddBounds(setup.robot.model.limits);
    solver_.resize(formulation_.nVar(), formulation_.nEq(), formulation_.nIn());
  }

  const char* name() const override { return "TSID"; }

  void Load(const State& state) override {
    state_ = state;
    ExportConfiguration(Library::kPinocchio, tree_, state.q, q_);
    ExportVelocity(Library::kPinocchio, tree_, state.q, state.v, v_);
  }

  bool Update() override {
    solution_ =
        &solver_.solve(formulation_.computeProblemData(state_.time, q_, v_));
    tau_ = formulation_.getActuatorForces(*solution_);
    return solution_->status == tsid::solvers::HQP_STATUS_OPTIMAL;
  }

  ControllerAnswer answer() override {
    const int nv = tree_.nv();
    ControllerAnswer answer = {
        VectorXd(nv + 6 * static_cast<int>(contacts_.size())), tau_};
    ImportAcceleration(Library::kPinocchio, tree_, state_.q, state_.v,
                       formulation_.getAccelerations(*solution_),
                       answer.y.head(nv));
    for (size_t i = 0; i < contacts_.size(); ++i) {
      tsid::contacts::Contact6d& contact = *contacts_[i];
      const Eigen::Matrix<double, 6, 1> force_moment =
          contact.getForceGeneratorMatrix() *
          formulation_.getContactForces(contact.name(), *solution_);
      answer.y.segment<6>(nv + 6 * i) << force_moment.tail<3>(),
          force_moment.head<3>();
    }
    return answer;
  }

 private:
  void AddContacts(const Robot& robot) {
    const double most =
        kMostWeights * tree_.total_mass() * tree_.gravity_W().norm();
    for (const Foot& foot : robot.feet) {
      contacts_.push_back(std::make_unique<tsid::contacts::Contact6d>(
          foot.name, wrapper_, foot.name, Corners(foot),
          Eigen::Vector3d::UnitZ(), ControllerOptions().friction, kLeastForce,
          most));
      SetGains(6, contacts_.back().get());
      contacts_.back()->setReference(wrapper_.framePosition(
          formulation_.data(), wrapper_.model().getFrameId(foot.name)));
      formulation_.addRigidContact(*contacts_.back(), kForceWeight);
    }
  }

  void AddTasks() {
    using Sample = tsid::trajectories::TrajectorySample;
    const int joints = tree_.num_joints();
    Sample com(3), posture(wrapper_.nq_actuated(), wrapper_.na());
    com.setValue(wrapper_.com(formulation_.data()));
    posture.setValue(q_.tail(wrapper_.nq_actuated()));
    com_.setReference(com);
    momentum_.setReference(Sample(3));
    posture_.setReference(posture);
    SetGains(3, &com_);
    SetGains(3, &momentum_);
    SetGains(joints, &posture_);
    formulation_.addMotionTask(com_, kComWeight, kTasks);
    formulation_.addMotionTask(momentum_, kMomentumWeight, kTasks);
    formulation_.addMotionTask(posture_, kPostureWeight, kTasks);
  }

  void AddBounds(const std::vector<JointLimits>& limits) {
    VectorXd effort(limits.size()), velocity(limits.size());
    for (size_t j = 0; j < limits.size(); ++j) {
      effort[j] = limits[j].effort;
      // 0: not known.
      velocity[j] = limits[j].velocity > 0
                        ? std::min(limits[j].velocity, kAssumedVelocity)
                        : kAssumedVelocity;
    }
    torque_bounds_.setBounds(-effort, effort);
    velocity_bounds_.setVelocityBounds(-velocity, velocity);
    formulation_.addActuationTask(torque_bounds_, 1, kConstraints);
    formulation_.addMotionTask(velocity_bounds_, 1, kConstraints);
  }

  Tree tree_;
  tsid::robots::RobotWrapper wrapper_;
  tsid::InverseDynamicsFormulationAccForce formulation_;
  std::vector<std::unique_ptr<tsid::contacts::Contact6d>> contacts_;
  tsid::tasks::TaskComEquality com_;
  tsid::tasks::TaskAMEquality momentum_;
  tsid::tasks::TaskJointPosture posture_;
  tsid::tasks::TaskActuationBounds torque_bounds_;
  tsid::tasks::TaskJointBounds velocity_bounds_;
  tsid::solvers::SolverHQuadProgFast solver_;
  State state_;
  VectorXd q_, v_, tau_;  // In Pinocchio's conventions.
  const tsid::solvers::HQPOutput* solution_ = nullptr;
};

}  // namespace

std::vector<std::unique_ptr<PeerController>> MakeControllers(
    const ControllerSetup& setup) {
  std::vector<std::unique_ptr<PeerController>> controllers;
  controllers.push_back(MakePoiseController(setup));
  controllers.push_back(std::make_unique<TsidPeer>(setup));
  return controllers;
}

}  // namespace poise
