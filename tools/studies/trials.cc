// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/studies/trials.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <utility>

#include "poise/robot/control/stand.h"
#include "poise/robot/finding.h"
#include "poise/robot/limits.h"
#include "poise/robot/profile/find_profile.h"
#include "poise/robot/profile/profile.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/observation.h"
#include "poise/sim/outcome.h"
#include "poise/sim/push.h"
#include "poise/sim/yardstick.h"

namespace poise {
namespace {

using Bar = Trial::Bar;

constexpr double kPi = 3.14159265358979323846;
constexpr double kSteadyError = 3e-3;  // m.
constexpr double kFlatFoot = 0.02;     // rad.
constexpr double kUprightLean = 0.02;  // rad.
// Largest growth of the tilt from the second quarter to the last one.
constexpr double kNoGrowth = 1e-3;  // rad.

// Fraction of the force that a pendulum on the robot's feet can take for
// kPushTime, in every direction.
constexpr double kOurPush = 0.9;
constexpr double kPushTime = 0.1;  // s.
constexpr int kDirections = 16;

constexpr const char* kHumanoid = "robot/models/humanoid.urdf";
constexpr const char* kScenarios = "sim/scenarios";

// A change of a scenario, and the option of `push` that makes the same change.
struct Change {
  std::string option;
  std::function<void(Scenario*)> apply;
};

// A change of one number, which `set` writes.
Change Number(const std::string& option, double value,
              void (*set)(double, Scenario*)) {
  return {option + " " + PrintNumber(value),
          [=](Scenario* scenario) { set(value, scenario); }};
}

Change Time(double s) {
  return Number("--time", s, [](double x, Scenario* to) { to->duration = x; });
}

Change MassError(double fraction) {
  return Number("--mass-error", fraction,
                [](double x, Scenario* to) { to->control.mass_error = x; });
}

Change Delay(double s) {
  return Number("--delay", s,
                [](double x, Scenario* to) { to->control.delay = x; });
}

Change Noise() {
  return Number("--noise", 1,
                [](double x, Scenario* to) { to->sensors.noise = x; });
}

Change Seed(unsigned seed) {
  return {"--seed " + std::to_string(seed),
          [=](Scenario* scenario) { scenario->seed = seed; }};
}

Change GroundFriction(double mu) {
  return Number("--mu-plant", mu,
                [](double x, Scenario* to) { to->plant.friction = x; });
}

Change TorqueScale(double scale) {
  return Number("--torque-scale", scale,
                [](double x, Scenario* to) { to->plant.torque_scale = x; });
}

Change Freeze(double at, double duration) {
  return {"--freeze " + PrintNumber(at) + "," + PrintNumber(duration),
          [=](Scenario* scenario) {
            scenario->sensors.freeze_at = at;
            scenario->sensors.freeze_for = duration;
          }};
}

Change ControlRate(double hz) {
  return Number("--control-rate", hz,
                [](double x, Scenario* to) { to->control.dt = 1 / x; });
}

Change With(const std::string& task) {
  return {"--with " + task,
          [=](Scenario* scenario) { scenario->control.with.push_back(task); }};
}

// Changes of the first push.
Change Force(double newton) {
  return Number("--force", newton, [](double x, Scenario* to) {
    Push& push = to->pushes.at(0);
    SetForce(x * push.force.normalized(), &push);
  });
}

Change PushDuration(double s) {
  return Number("--duration", s,
                [](double x, Scenario* to) { to->pushes.at(0).duration = x; });
}

Change Direction(double degrees) {
  return Number("--direction", degrees, [](double x, Scenario* to) {
    Eigen::Vector3d& force = to->pushes.at(0).force;
    const double angle = x * kPi / 180;
    force = force.norm() * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
  });
}

void Apply(const Change& change, Trial* trial) {
  change.apply(&trial->experiment.scenario);
  trial->options += " " + change.option;
}

// Makes a trial of a robot in one of our scenarios, with changes.
Trial Make(const std::string& what, const Robot& robot,
           const std::string& scenario, const std::vector<Change>& changes,
           Bar bar = Bar::kRecovers) {
  const std::filesystem::path file =
      std::filesystem::path(kScenarios) / (scenario + ".yaml");
  Trial trial{what, {robot, LoadScenario(file)}, "--scenario " + scenario, bar};
  for (const Change& change : changes) Apply(change, &trial);
  return trial;
}

// Adds the paper's scenarios at another control rate, Hz.
void AddRate(const Robot& robot, double rate, std::vector<Trial>* trials) {
  const std::string hz = PrintNumber(rate) + " Hz: ";
  for (const char* name :
       {"stand", "posture_off", "com_sinusoid", "weak_push", "strong_push"}) {
    trials->push_back(Make(hz + name, robot, name, {ControlRate(rate)}));
  }
  const char* without_zmp = "strong_push_without_zmp";
  trials->push_back(Make(hz + without_zmp, robot, without_zmp,
                         {ControlRate(rate)}, Bar::kFalls));
  trials->push_back(Make(hz + "figure 12", robot, "strong_push",
                         {With("zmp"), PushDuration(0.12), ControlRate(rate)}));
}

Change BaseEstimated() {
  return {"--estimator",
          [](Scenario* scenario) { scenario->control.estimator = true; }};
}

Change MuJoCo() {
  return {"--plant mujoco",
          [](Scenario* scenario) { scenario->plant_kind = "mujoco"; }};
}

Change Gains(const std::string& file) {
  const std::string path = "tools/studies/" + file;
  return {"--tasks " + path,
          [=](Scenario* scenario) { scenario->control.tasks = path; }};
}

// Largest impulse that a direction aims at, N s: see docs/steps.md. The
// directions are 22.5 degrees apart, from 0 to 180; the other side is the same.
double AimedImpulse(int direction) {
  constexpr double kAims[] = {50, 50, 45, 37.5, 37.5, 37.5, 45, 50, 50};
  return kAims[direction <= 8 ? direction : 16 - direction];
}

// Returns the force that a pendulum on the robot's feet can take in the
// direction of the first push, N.
double PendulumForce(const Experiment& experiment) {
  const Robot& robot = experiment.robot;
  const Push& push = experiment.scenario.pushes.at(0);
  const PushOnRobot aimed(robot, push);
  const Eigen::Vector2d u = push.force.head<2>();
  return ComputeYardstick(robot, robot.q_nominal, u, kPushTime, aimed.body(),
                          aimed.p_BoQ_B())
             .value()
             .lipm_Ns /
         kPushTime;
}

// Makes a trial that pushes with a fraction of the force that a pendulum on the
// robot's feet can take.
Trial MakePush(const std::string& what, const Robot& robot, double fraction,
               const std::vector<Change>& changes) {
  Trial unit = Make(what, robot, "strong_push", {Force(1)});
  for (const Change& change : changes) Apply(change, &unit);
  // Some trials are chaotic: their result depends on this rounding to 1e-6 N.
  const double force =
      std::round(1e6 * fraction * PendulumForce(unit.experiment)) / 1e6;
  std::vector<Change> all = {Force(force)};
  all.insert(all.end(), changes.begin(), changes.end());
  return Make(what, robot, "strong_push", all);
}

void AddDirections(const Robot& robot, std::vector<Trial>* trials) {
  for (int k = 0; k < kDirections; ++k) {
    const double degrees = 360. * k / kDirections;
    trials->push_back(MakePush(
        "0.9 of a pendulum's push at " + PrintNumber(degrees) + " degrees",
        robot, kOurPush,
        {PushDuration(kPushTime), Time(5), Direction(degrees)}));
  }
}

bool Holds(Bar bar, const TrialResult& result) {
  const Verdict& verdict = result.verdict;
  if (bar == Bar::kFalls) return !verdict.recovered;
  if (!verdict.recovered) return false;
  switch (bar) {
    case Bar::kSteady:
      return verdict.com_error_final.cwiseAbs().maxCoeff() < kSteadyError;
    case Bar::kFlat:
      return verdict.foot_tilt_peak < kFlatFoot;
    case Bar::kUpright:
      return result.lean_peak < kUprightLean &&
             result.lean_late < result.lean_early + kNoGrowth;
    default:
      return true;
  }
}

}  // namespace

std::vector<Trial> RobustnessTrials() {
  const Robot robot = LoadStandingRobot(
      kHumanoid, LoadProfile(FindProfile("humanoid", kHumanoid)));
  std::vector<Trial> trials;
  const auto strong = [&](const std::string& what, std::vector<Change> changes,
                          Bar bar = Bar::kRecovers) {
    changes.insert(changes.begin(), Time(8));
    trials.push_back(Make(what, robot, "strong_push", changes, bar));
  };
  strong("nothing wrong", {}, Bar::kSteady);
  strong("model 10 % too heavy", {MassError(0.1)}, Bar::kSteady);
  strong("model 10 % too light", {MassError(-0.1)}, Bar::kSteady);
  strong("delay of 2 ms", {Delay(0.002)});
  strong("delay of 5 ms", {Delay(0.005)});
  strong("noise: 2 mrad, 0.1 rad/s", {Noise()});
  strong("noise, another seed", {Noise(), Seed(2)});
  strong("noise, a third seed", {Noise(), Seed(3)});
  strong("friction 0.3 in the plant", {GroundFriction(0.3)});
  strong("torque limits halved", {TorqueScale(0.5)});
  strong("sensors frozen for 20 ms", {Freeze(1.05, 0.02)});
  for (const auto& [what, error] : {std::pair("all of it, too heavy", 0.1),
                                    std::pair("all of it, too light", -0.1)}) {
    trials.push_back(
        Make(what, robot, "weak_push",
             {Delay(0.002), Noise(), GroundFriction(0.3), MassError(error)}));
  }
  for (const char* name : {"stand", "weak_push", "strong_push"}) {
    Trial trial = Make("base estimated: " + std::string(name), robot, name, {});
    trial.experiment.scenario.control.estimator = true;
    trial.options = "--estimator " + trial.options;
    trials.push_back(trial);
  }
  trials.push_back(Make("the sinusoid for 64 s", robot, "com_sinusoid",
                        {Time(64)}, Bar::kUpright));
  strong("50 N for 0.4 s", {Force(50), PushDuration(0.4)}, Bar::kFlat);
  strong("100 N for 0.2 s", {Force(100), PushDuration(0.2)}, Bar::kFlat);
  for (const double rate : {500, 200, 100}) AddRate(robot, rate, &trials);
  AddDirections(robot, &trials);
  return trials;
}

std::vector<Trial> StepTrials() {
  constexpr double kShare = 0.8;
  const Robot robot = LoadStandingRobot(
      kHumanoid, LoadProfile(FindProfile("humanoid", kHumanoid)));
  const std::vector<std::pair<std::string, std::vector<Change>>> errors = {
      {"nothing wrong", {}},
      {"model 10 % too heavy", {MassError(0.1)}},
      {"model 10 % too light", {MassError(-0.1)}},
      {"delay of 2 ms", {Delay(0.002)}},
      {"delay of 5 ms", {Delay(0.005)}},
      {"noise, base estimated", {Noise(), BaseEstimated()}},
      {"friction 0.5 in the plant", {GroundFriction(0.5)}},
      {"500 Hz", {ControlRate(500)}},
      {"200 Hz", {ControlRate(200)}},
      {"MuJoCo", {MuJoCo()}},
      {"gains 20 % higher", {Gains("gains_high.yaml")}},
      {"gains 20 % lower", {Gains("gains_low.yaml")}}};
  std::vector<Trial> trials;
  for (const auto& [what, wrong] : errors) {
    for (int k = 0; k < kDirections; ++k) {
      const double degrees = 360. * k / kDirections;
      std::vector<Change> changes = {
          Force(kShare * AimedImpulse(k) / kPushTime), PushDuration(kPushTime),
          Direction(degrees)};
      changes.insert(changes.end(), wrong.begin(), wrong.end());
      trials.push_back(
          Make("step, " + PrintNumber(degrees) + " degrees: " + what, robot,
               "shove", changes));
    }
  }
  return trials;
}

TrialResult Try(const Trial& trial) {
  const auto& [robot, scenario] = trial.experiment;
  ClosedLoop loop(robot, scenario);
  Judge judge(StandingHeight(robot), scenario.steps);
  TrialResult result;
  const long ticks = std::lround(scenario.duration / scenario.control.dt);
  for (long k = 0; k < ticks && !judge.is_down(); ++k) {
    loop.Tick();
    const TickRecord record = loop.record();
    judge.Look(record.observation);
    const double lean = record.observation.base_tilt;
    result.lean_peak = std::max(result.lean_peak, lean);
    double* quarter = 4 * k / ticks == 1   ? &result.lean_early
                      : 4 * k / ticks == 3 ? &result.lean_late
                                           : nullptr;
    if (quarter != nullptr) *quarter = std::max(*quarter, lean);
    if (!record.end.self_contacts.empty()) ++result.self_contact_ticks;
    result.joint_violation = std::max(
        result.joint_violation, JointViolation(robot.model, record.end.q));
  }
  result.verdict = judge.Conclude();
  result.holds = Holds(trial.bar, result);
  return result;
}

std::string ToRow(const Trial& trial, const TrialResult& result) {
  const Verdict& verdict = result.verdict;
  char violation[40] = "0";
  if (result.joint_violation > 0) {
    std::snprintf(violation, sizeof(violation), "%.0e", result.joint_violation);
  }
  const Eigen::Vector3d peak = 1e3 * verdict.com_error_peak;
  const Eigen::Vector3d last = 1e3 * verdict.com_error_final;
  char text[200];
  std::snprintf(text, sizeof(text),
                " | %s | %.1f, %.1f, %.1f | %.2f, %.2f, %.2f | %.4f | %.3f, "
                "%.3f | %s | %d | %s |",
                Outcome(verdict).c_str(), peak.x(), peak.y(), peak.z(),
                last.x(), last.y(), last.z(), verdict.foot_tilt_peak,
                result.lean_peak, result.lean_late, violation,
                result.self_contact_ticks, result.holds ? "yes" : "**no**");
  return "| " + trial.what + " | `" + trial.options + "`" + text;
}

}  // namespace poise
