// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/limits.h"
#include "poise/sim/command/command_watch.h"
#include "poise/sim/command/push_bound.h"
#include "poise/sim/observation.h"
#include "poise/sim/quantile.h"

namespace poise {

namespace {

TickTimes Summarize(std::vector<float> us) {
  if (us.empty()) return {};
  return {Quantile(&us, 0.5), Quantile(&us, 0.99), Quantile(&us, 0.999),
          Quantile(&us, 1)};
}

double TorqueViolation(const RobotModel& model, double scale,
                       const Eigen::VectorXd& tau) {
  double worst = 0;
  for (int j = 0; j < model.tree.num_joints(); ++j) {
    worst = std::max(worst, std::abs(tau[j]) - scale * model.limits[j].effort);
  }
  return worst;
}

// Adds a tick to the peaks and counts of the result.
void Count(const TickRecord& record, const RobotModel& model,
           double torque_scale, RunResult* result) {
  result->iterations_max =
      std::max(result->iterations_max, record.report.iterations);
  result->certificate_max =
      std::max(result->certificate_max, record.report.certificate.worst());
  result->gap_max =
      std::max(result->gap_max, record.report.certificate.relative_gap);
  if (record.report.status == TickStatus::kTruncated ||
      record.report.status == TickStatus::kFailSafe) {
    ++result->failures;
  }
  result->joint_limit_violation_peak = std::max(
      result->joint_limit_violation_peak, JointViolation(model, record.end.q));
  result->torque_limit_violation_peak =
      std::max(result->torque_limit_violation_peak,
               TorqueViolation(model, torque_scale, record.tau));
  if (!record.end.self_contacts.empty()) ++result->self_contact_ticks;
}

// Returns RunResult::blew_up for a velocity; empty if all joints are slow.
std::string FindBlowUp(const Tree& tree, const Eigen::VectorXd& v) {
  constexpr double kAbsurd = 1000;  // rad/s or m/s.
  for (int j = 0; j < tree.num_joints(); ++j) {
    const double speed = v[tree.v_start() + j];
    if (std::abs(speed) <= kAbsurd) continue;  // A NaN counts as absurd.
    const bool slides = tree.joints()[j].type == JointType::kPrismatic;
    return "the controller blew up: joint " + Quoted(tree.joints()[j].name) +
           " moved at " + PrintNumber(speed) + (slides ? " m/s" : " rad/s");
  }
  return "";
}

// Returns the impulse that a pendulum in place of this robot recovers from, on
// the feet that are planned to be down when the push begins.
std::optional<Yardstick> Measure(const Robot& robot, const Push& push,
                                 const TickRecord& begin) {
  std::vector<bool> down;
  for (const FootObservation& foot : begin.observation.feet) {
    down.push_back(foot.down);
  }
  return BoundOfPush(robot, begin.start.q, push, down);
}

bool HasHappened(const CommandedStep& command,
                 const std::vector<TakenStep>& steps) {
  constexpr double kNear = 0.01;  // m.
  return std::any_of(steps.begin(), steps.end(), [&](const TakenStep& step) {
    return step.is_commanded && step.has_landed && step.foot == command.foot &&
           step.at >= command.at && (step.landed - command.to).norm() < kNear;
  });
}

// Returns the commanded steps that did not happen, in words. The loop gives the
// commands one after the other, in the order of the scenario.
std::vector<std::string> MissedSteps(const Scenario& scenario,
                                     const RunResult& result) {
  std::vector<std::string> missed;
  std::size_t given = 0;
  for (const StanceEvent& event : scenario.stance) {
    if (event.kind != StanceEvent::Kind::kStep) continue;
    const std::string which = "step of " + OneLine(event.foot) + " to (" +
                              PrintNumber(event.to.x()) + ", " +
                              PrintNumber(event.to.y()) + ") m at " +
                              PrintNumber(event.at) + " s: ";
    if (given == result.commanded.size()) {
      if (result.interrupted) break;
      missed.push_back(which + (result.verdict.fell_at
                                    ? "the robot fell before"
                                    : "the run ended before"));
      continue;
    }
    const CommandedStep& command = result.commanded[given++];
    if (command.answer != StepAnswer::kAccepted) {
      missed.push_back(which + "refused, because " +
                       std::string(Describe(command.answer)));
    } else if (!HasHappened(command, result.steps)) {
      missed.push_back(which +
                       "the foot did not land within 10 mm of its place");
    }
  }
  return missed;
}

// Writes not_done and commanded_done from the commands of a run that has ended.
void JudgeCommands(const ClosedLoop& loop, const CommandWatch& watch,
                   RunResult* result) {
  const Scenario& scenario = loop.scenario();
  const auto is_step = [](const StanceEvent& event) {
    return event.kind == StanceEvent::Kind::kStep;
  };
  if (std::any_of(scenario.stance.begin(), scenario.stance.end(), is_step)) {
    result->not_done = MissedSteps(scenario, *result);
    result->commanded_done = result->not_done.empty();
  }
  // A robot that fell early has missed the commands that followed.
  const double end = result->interrupted ? result->duration : scenario.duration;
  if (watch.has_command(end)) {
    for (const std::string& missed : watch.Missed(end)) {
      result->not_done.push_back(missed);
    }
    result->commanded_done = result->not_done.empty();
  }
  for (const std::string& missed : loop.impossible()) {
    result->not_done.push_back(missed);
    result->commanded_done = false;
  }
}

// Returns after how many ticks progress() is called: at least 100 times per
// run, and at least every 1000 plant steps. So a run with many or slow ticks
// can be stopped quickly, too.
long TicksBetweenReports(const Scenario& scenario, long ticks) {
  const long steps = std::lround(scenario.control.dt / scenario.plant.dt);
  return std::clamp(ticks / 100, 1L, std::max(1L, 1000 / steps));
}

}  // namespace

std::string FellBy(const RunResult& result) {
  const bool by_itself = result.blew_up.empty() || !result.verdict.fell_at;
  return by_itself ? result.verdict.fell_by : result.blew_up;
}

std::optional<double> TooShortAfterPushes(const Scenario& scenario,
                                          const RunResult& result) {
  constexpr double kRounding = 1e-9;  // s.
  const double after = TimeAfterPushes(scenario.pushes, result.duration);
  if (after >= Judge::kEnd - kRounding) return std::nullopt;
  return after;
}

RunResult Run(ClosedLoop* loop, const std::filesystem::path& folder,
              const std::function<bool(double)>& progress, LogFormat format) {
  using Clock = std::chrono::steady_clock;
  const Robot& robot = loop->robot();
  const Scenario& scenario = loop->scenario();
  std::unique_ptr<Recorder> recorder;
  if (!folder.empty()) {
    recorder = std::make_unique<Recorder>(folder, robot,
                                          loop->controller().stack(), format);
  }
  // In the nominal posture the robot stands on the ground.
  Judge judge(StandingHeight(robot), scenario.steps);
  const long ticks = std::lround(scenario.duration / scenario.control.dt);
  const long between = TicksBetweenReports(scenario, ticks);
  std::vector<float> us, modelled_us;
  us.reserve(ticks);
  modelled_us.reserve(ticks);
  StepWatch step_watch;
  CommandWatch command_watch(robot, scenario,
                             loop->controller().stance().settings());
  RunResult result;
  const Push* push = LargestPush(scenario.pushes, scenario.duration);
  if (push != nullptr) {
    result.impulse_Ns = ImpulseOf(*push, scenario.duration);
    result.push_duration = push->duration;
  }
  const auto before = Clock::now();
  while (result.ticks < ticks && !judge.is_down() && !result.interrupted) {
    loop->Tick();
    const TickRecord record = loop->record();
    if (push != nullptr &&
        HasBegun(*push, record.observation.time, scenario.control.dt)) {
      result.yardstick = Measure(robot, *push, record);
      result.impulse_Ns = ImpulseOf(*push, scenario.duration);
      push = nullptr;
    }
    ++result.ticks;
    if (result.blew_up.empty() && !judge.has_fallen()) {
      result.blew_up = FindBlowUp(robot.model.tree, record.start.v);
    }
    judge.Look(record.observation);
    command_watch.Look(record.observation);
    if (record.gait != nullptr) step_watch.Look(record);
    if (recorder != nullptr) recorder->Record(record);
    us.push_back(static_cast<float>(record.microseconds));
    modelled_us.push_back(
        static_cast<float>(1e6 * record.report.modelled_seconds));
    Count(record, robot.model, scenario.plant.torque_scale, &result);
    if (progress && result.ticks % between == 0) {
      result.interrupted = !progress(static_cast<double>(result.ticks) /
                                     static_cast<double>(ticks));
    }
  }
  result.wall_seconds =
      std::chrono::duration<double>(Clock::now() - before).count();
  result.duration = static_cast<double>(result.ticks) * scenario.control.dt;
  result.verdict = judge.Conclude();
  if (TooShortAfterPushes(scenario, result)) result.verdict.recovered = false;
  result.steps = step_watch.steps();
  result.commanded = loop->commanded();
  JudgeCommands(*loop, command_watch, &result);
  result.tick_us = Summarize(std::move(us));
  result.modelled_us = Summarize(std::move(modelled_us));
  if (recorder != nullptr) {
    recorder->Flush();
    result.log_sha256 = recorder->log_sha256();
    result.rows = loop->controller().stack().DescribeRows();
  }
  return result;
}

RunResult Run(const Robot& robot, const Scenario& scenario,
              const std::filesystem::path& folder,
              const std::function<bool(double)>& progress, LogFormat format) {
  ClosedLoop loop(robot, scenario);
  return Run(&loop, folder, progress, format);
}

}  // namespace poise
