// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/closed_loop.h"

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "poise/robot/control/posture/one_foot.h"
#include "poise/robot/finding.h"
#include "poise/robot/input_error.h"
#include "poise/sim/command/fit_to_robot.h"
#include "poise/sim/command/make_controller.h"
#include "poise/sim/command/push_bound.h"
#include "poise/sim/command/shift_height.h"
#include "poise/sim/observation.h"
#include "poise/sim/plants/make_plant.h"
#include "poise/sim/start_state.h"

namespace poise {

namespace {

// A smaller lean is left out, rad: unless its joints force a robot to lean, it
// stays upright exactly.
constexpr double kLeastLean = 0.01;

// The noise of the sensors must not depend on the random start state.
constexpr unsigned kSensorSeed = 0x5eed;

constexpr char kGaitMoves[] =
    " s: from the first step on, the gait alone moves the ";

// Returns what a command of the scenario is, in words.
std::string Name(const StanceEvent& event) {
  switch (event.kind) {
    case StanceEvent::Kind::kLift:
      return "lift of " + OneLine(event.foot);
    case StanceEvent::Kind::kPutDown:
      return "put_down of " + OneLine(event.foot);
    case StanceEvent::Kind::kShift:
      return "shift";
    case StanceEvent::Kind::kStep:
      return "step of " + OneLine(event.foot);
  }
  return "";
}

State ToState(const Measurement& measurement) {
  const int n = static_cast<int>(measurement.q_joints.size());
  State state{measurement.time, Eigen::VectorXd(n + 7), Eigen::VectorXd(n + 6)};
  state.q << measurement.X_WB.p,
      Eigen::Quaterniond(measurement.X_WB.R).coeffs(), measurement.q_joints;
  state.v << measurement.V_WB_W, measurement.v_joints;
  return state;
}

std::vector<PushOnRobot> Aim(const std::vector<Push>& pushes,
                             const Robot& robot) {
  std::vector<PushOnRobot> aimed;
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    MakeOfField(EntryPath("pushes", i) + ".link",
                [&] { aimed.emplace_back(robot, pushes[i]); });
  }
  return aimed;
}

// Returns the scenario for this robot. A push that is a fraction of a bound has
// the force for the nominal posture until it begins.
Scenario Fitted(const Robot& robot, const Scenario& scenario) {
  Validate(scenario);
  Scenario fitted = FitToRobot(robot, scenario);
  for (std::size_t i = 0; i < fitted.pushes.size(); ++i) {
    Push& push = fitted.pushes[i];
    if (push.impulse_fraction && !(push.duration > 0)) {
      throw InputError::OfValue(
          EntryPath("pushes", i) + ".duration",
          " is " + PrintNumber(push.duration) +
              " s, must be above 0 s, because the impulse of the push is a "
              "fraction of the bound");
    }
    if (push.impulse_fraction && !BoundOfPush(robot, robot.q_nominal, push)) {
      throw InputError::OfValue(
          EntryPath("pushes", i) + (push.point ? ".point" : ".link"),
          " is below the soles, must be above them, because the impulse of the "
          "push is a fraction of the bound at this height; give the force in "
          "N");
    }
    // Whether the CoM is above the soles is decided when the push begins.
    (void)ApplyFraction(robot, robot.q_nominal, {}, push.force, &push);
  }
  return fitted;
}

}  // namespace

ClosedLoop::ClosedLoop(const Robot& robot, const Scenario& scenario,
                       const std::function<void(Stack*)>& add_tasks)
    : robot_(robot),
      scenario_(Fitted(robot, scenario)),
      plant_(MakeOfField("robot",
                         [&] {
                           return MakePlant(robot, scenario_.plant_kind,
                                            scenario_.plant);
                         })),
      controller_(MakeController(robot, scenario_, add_tasks)),
      sensors_(robot, scenario_.sensors, scenario_.seed ^ kSensorSeed),
      observer_(robot, scenario_.plant.ground),
      pushes_(Aim(scenario_.pushes, robot)),
      is_sized_(scenario_.pushes.size(), false),
      down_(robot.feet.size(), true),
      steps_per_tick_(static_cast<int>(
          std::lround(scenario_.control.dt / scenario_.plant.dt))),
      delay_steps_(static_cast<int>(
          std::lround(scenario_.control.delay / scenario_.plant.dt))) {
  const State start = MakeStartState(robot, scenario_.start,
                                     scenario_.plant.ground, scenario_.seed);
  plant_->Reset(start.q, start.v);
  // The controller receives the place of the floor, but not the drop.
  StartSettings on_ground = scenario_.start;
  on_ground.drop = 0;
  controller_->Start(
      MakeStartState(robot, on_ground, scenario_.plant.ground, scenario_.seed));
  if (scenario_.control.estimator) {
    estimator_ = MakeOfField(
        "robot", [&] { return std::make_unique<Estimator>(robot); });
    estimator_->Start(sensors_.Measure(plant_->Sense()));
    state_ = ToState(sensors_.measurement());
  }
  if (scenario_.steps) {
    GaitSettings settings;
    settings.dt = scenario_.control.dt;
    gait_ = MakeOfField("robot", [&] {
      return std::make_unique<Gait>(controller_->robot(), settings);
    });
  }
  for (const Push& push : scenario.pushes) directions_.push_back(push.force);
  com_start_ = controller_->reference().p_WG;
  com_path_ = {scenario_.com, com_start_};
  lean_path_ = LeanPath(controller_->reference().R_WB);
  for (std::size_t i = 0; i < scenario_.stance.size(); ++i) {
    const std::string& foot = scenario_.stance[i].foot;
    if (!foot.empty())
      MakeOfField(EntryPath("stance", i), [&] { FindFoot(foot); });
  }
  command_.tau.setZero(robot.model.tree.num_joints());
  start_ = plant_->Sense();
  during_ = start_;
}

void ClosedLoop::AddPush(const Push& push) {
  Scenario one = scenario_;
  one.pushes = {push};
  const Push fitted = Fitted(robot_, one).pushes.front();
  pushes_.push_back(Aim({fitted}, robot_).front());
  scenario_.pushes.push_back(fitted);
  directions_.push_back(push.force);
  is_sized_.push_back(false);
}

int ClosedLoop::FindFoot(const std::string& name) const {
  for (size_t i = 0; i < robot_.feet.size(); ++i) {
    if (robot_.feet[i].name == name) return static_cast<int>(i);
  }
  std::string feet;
  for (const Foot& foot : robot_.feet) {
    feet += (feet.empty() ? "" : ", ") + foot.name;
  }
  throw std::invalid_argument("stance: foot " + Quoted(name) +
                              " is unknown, must be a foot of robot " +
                              Quoted(robot_.model.name) + ": " + feet);
}

void ClosedLoop::MoveFeet() {
  const std::vector<StanceEvent>& events = scenario_.stance;
  for (; next_event_ < events.size(); ++next_event_) {
    // With this tolerance, rounding cannot delay an event by a tick.
    if (events[next_event_].at > time() + plant_->dt() / 2) break;
    MoveFoot(events[next_event_]);
  }
}

void ClosedLoop::MoveFoot(const StanceEvent& event) {
  if (event.kind == StanceEvent::Kind::kStep) {
    const int foot = FindFoot(event.foot);
    commanded_.push_back(
        {time(), foot, event.to, gait_->StepTo(foot, event.to, *controller_)});
    return;
  }
  // After the first step, the gait alone moves the feet and the CoM.
  if (gait_ != nullptr && gait_->owns_com()) {
    const bool shifts = event.kind == StanceEvent::Kind::kShift;
    impossible_.push_back(Name(event) + " at " + PrintNumber(event.at) +
                          kGaitMoves + (shifts ? "CoM" : "feet"));
    return;
  }
  switch (event.kind) {
    case StanceEvent::Kind::kLift:
      (void)controller_->stance().Lift(FindFoot(event.foot), event.height);
      break;
    case StanceEvent::Kind::kPutDown:
      controller_->stance().PutDown(FindFoot(event.foot));
      break;
    case StanceEvent::Kind::kShift:
      Shift(event);
      break;
    case StanceEvent::Kind::kStep:
      break;
  }
}

// Shifts the CoM over a foot, or back to its start. The base leans if the hips
// are weak, and the CoM sinks if the other leg is too short for its height.
void ClosedLoop::Shift(const StanceEvent& event) {
  Eigen::Vector3d place = com_start_, lean_W = Eigen::Vector3d::Zero();
  if (!event.foot.empty()) {
    const int foot = FindFoot(event.foot);
    std::vector<Pose> X_WC;
    for (const ContactTick& each : controller_->contacts()) {
      X_WC.push_back(each.X_WC);
    }
    place = ShiftedCenterOfMass(robot_, foot, X_WC, com_start_);
    if (X_WC.size() == 2) {
      const Eigen::Vector2d G = (X_WC[foot].Inverse() * place).head<2>();
      const OneFootPosture posture = FindOneFootPosture(robot_, foot, G);
      if (posture.lean_W.norm() > kLeastLean) lean_W = posture.lean_W;
      place.z() -= SinkOfShift(robot_, foot, G, posture.lean);
    }
  }
  com_path_.ShiftTo(place, event.at, event.over);
  lean_path_.LeanTo(lean_W, event.at, event.over);
}

void ClosedLoop::Tick() {
  using Clock = std::chrono::steady_clock;
  start_ = plant_->Sense();
  const bool owned_com = gait_ != nullptr && gait_->owns_com();
  MoveFeet();
  if (gait_ == nullptr || !gait_->owns_com()) {
    com_path_.Write(time(), &controller_->reference());
    lean_path_.Write(time(), &controller_->reference());
  }
  const Measurement& measurement = sensors_.Measure(start_);
  if (estimator_ == nullptr) state_ = ToState(measurement);
  const auto before = Clock::now();
  if (estimator_ != nullptr) estimator_->Update(measurement, &state_);
  if (gait_ != nullptr) gait_->Update(controller_.get());
  controller_->Update(state_, &command_);
  microseconds_ =
      std::chrono::duration<double, std::micro>(Clock::now() - before).count();
  for (size_t i = 0; i < down_.size(); ++i) {
    down_[i] = controller_->stance().is_meant_down(static_cast<int>(i));
  }
  observer_.ObserveState(start_, down_, controller_->reference().p_WG);
  if (gait_ != nullptr && gait_->owns_com()) {
    observer_.MoveComReference(controller_->contacts());
  }
  const bool moves_com =
      !scenario_.com.sine.isZero() || !scenario_.com.cosine.isZero();
  if (!owned_com && gait_ != nullptr && gait_->owns_com() && moves_com) {
    impossible_.push_back("motion of the CoM after " +
                          PrintNumber(start_.time) + kGaitMoves + "CoM");
  }
  SizePushes();
  StepPlant();
  observer_.ObserveForces(during_.F_Co_C);
  ++ticks_;
}

// Sets the force of each push that begins in this tick and is a fraction of a
// bound. The bound is that of the present state on the feet meant to be down.
void ClosedLoop::SizePushes() {
  for (std::size_t i = 0; i < pushes_.size(); ++i) {
    Push& push = scenario_.pushes[i];
    const bool begins =
        !is_sized_[i] && HasBegun(push, start_.time, scenario_.control.dt);
    if (!begins || !push.impulse_fraction) continue;
    is_sized_[i] = true;
    if (!ApplyFraction(robot_, start_.q, down_, directions_[i], &push)) {
      impossible_.push_back(
          "push at " + PrintNumber(push.start) +
          " s: its force is 0 N, a fraction of a bound of 0 N s, because the "
          "CoM is not above the soles on the ground, or the push is below the "
          "soles; give the force in N");
    }
    pushes_[i] = PushOnRobot(robot_, push);
  }
}

void ClosedLoop::StepPlant() {
  // The first command fills the delay, because there is no older command.
  while (static_cast<int>(torques_.size()) < delay_steps_ + steps_per_tick_) {
    torques_.push_back(command_.tau);
  }
  const double share = 1.0 / steps_per_tick_;
  const int num_feet = static_cast<int>(robot_.feet.size());
  std::vector<Eigen::Matrix<double, 6, 1>> F_Co_C(
      num_feet, Eigen::Matrix<double, 6, 1>::Zero());
  push_force_W_.setZero();
  for (int step = 0; step < steps_per_tick_; ++step) {
    for (const PushOnRobot& push : pushes_) {
      const auto force =
          push.At(time(), plant_->dt(), observer_.R_WB(push.body()));
      if (!force) continue;
      plant_->Apply(*force);
      push_force_W_ += share * force->force_W;
    }
    plant_->Step(torques_.front());
    torques_.pop_front();
    for (int i = 0; i < num_feet; ++i) {
      F_Co_C[i] += share * plant_->Sense().F_Co_C[i];
    }
  }
  during_ = plant_->Sense();
  during_.F_Co_C = F_Co_C;
}

TickRecord ClosedLoop::record() const {
  return {ticks_ - 1,
          observer_.observation(),
          start_,
          during_,
          command_.tau,
          push_force_W_,
          controller_->stack(),
          controller_->hierarchy(),
          controller_->report(),
          controller_->stance(),
          gait_.get(),
          robot_.model.tree.nv(),
          microseconds_};
}

}  // namespace poise
