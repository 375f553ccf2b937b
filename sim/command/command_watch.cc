// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/command_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/robot/finding.h"

namespace poise {
namespace {

using Kind = StanceEvent::Kind;

constexpr double kPi = 3.14159265358979323846;

// Part of its period after which the motion of the CoM is judged.
constexpr double kLeastPeriod = 0.5;

std::string Millimeters(double meters) {
  return PrintNumber(std::round(1e4 * meters) / 10) + " mm";
}

int FindFoot(const Robot& robot, const std::string& name) {
  for (std::size_t i = 0; i < robot.feet.size(); ++i) {
    if (robot.feet[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

// Returns the time that the motion of a command takes, s.
double TimeOf(const StanceEvent& event, const StanceSettings& stance) {
  return event.kind == Kind::kShift ? event.over
                                    : stance.fade_time + stance.swing_time;
}

// Returns whether a later command ends an earlier one.
bool Ends(const StanceEvent& later, const StanceEvent& earlier) {
  return later.kind == Kind::kShift ? earlier.kind == Kind::kShift
                                    : later.foot == earlier.foot;
}

}  // namespace

CommandWatch::CommandWatch(const Robot& robot, const Scenario& scenario,
                           const StanceSettings& stance)
    : dt_(scenario.control.dt), com_(scenario.com) {
  const std::vector<StanceEvent>& events = scenario.stance;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i].kind == Kind::kStep) continue;  // See StepWatch.
    Command command;
    command.event = events[i];
    command.foot = FindFoot(robot, events[i].foot);
    command.ready = events[i].at + TimeOf(events[i], stance);
    command.until = std::numeric_limits<double>::infinity();
    for (std::size_t k = i + 1; k < events.size(); ++k) {
      if (!Ends(events[k], events[i])) continue;
      command.until = events[k].at;
      break;
    }
    commands_.push_back(command);
  }
}

void CommandWatch::Look(const Observation& now) {
  if (!has_begun_) com_start_ = now.com;
  has_begun_ = true;
  const double phase = 2 * kPi * now.time / com_.period;
  const auto add = [&](const Eigen::Vector3d& p, Component* component) {
    component->cosine += std::cos(phase) * (p - com_start_);
    component->sine += std::sin(phase) * (p - com_start_);
  };
  add(now.com_ref, &commanded_);
  add(now.com, &moved_);
  for (Command& command : commands_) {
    const bool is_on = command.event.at < now.time + dt_ / 2 &&
                       now.time < command.until - dt_ / 2;
    if (is_on) LookAt(now, &command);
  }
}

void CommandWatch::LookAt(const Observation& now, Command* command) const {
  const bool is_first = !command->has_begun;
  command->has_begun = true;
  if (command->event.kind == Kind::kShift) {
    if (is_first) command->begin = now.com_ref;
    if (now.time < command->ready - dt_ / 2) return;
    const double distance = (now.com - now.com_ref).head<2>().norm();
    const bool is_ready = command->way > 0;
    command->best = is_ready ? std::min(command->best, distance) : distance;
    command->way = (now.com_ref - command->begin).head<2>().norm();
    command->is_done = command->best <= kShiftShare * command->way ||
                       command->is_done || command->way == 0;
    return;
  }
  const FootObservation& foot = now.feet[command->foot];
  if (is_first) command->ground = foot.X_WC.p.z();
  command->best = std::max(command->best, foot.X_WC.p.z() - command->ground);
  if (command->event.kind == Kind::kLift) {
    command->is_done = command->best >= kLiftShare * command->event.height;
  } else {
    const bool is_late = now.time > command->ready - dt_ / 2;
    command->is_done |= foot.down && foot.in_contact && is_late;
  }
}

bool CommandWatch::IsJudged(const Command& command, double end) {
  return command.ready < std::min(command.until, end);
}

bool CommandWatch::IsMotionJudged(double end) const {
  const bool moves = !com_.sine.isZero() || !com_.cosine.isZero();
  return moves && end >= kLeastPeriod * com_.period;
}

// Projects the motion onto the command, both as complex amplitudes. The phase
// of the product is the lag.
double CommandWatch::MotionShare() const {
  const Component& c = commanded_;
  const Component& m = moved_;
  const double along = c.cosine.dot(m.cosine) + c.sine.dot(m.sine);
  const double across = c.cosine.dot(m.sine) - c.sine.dot(m.cosine);
  const double whole = c.cosine.squaredNorm() + c.sine.squaredNorm();
  return along > 0 && whole > 0 ? std::hypot(along, across) / whole : 0;
}

bool CommandWatch::has_command(double end) const {
  return IsMotionJudged(end) ||
         std::any_of(commands_.begin(), commands_.end(),
                     [&](const Command& each) { return IsJudged(each, end); });
}

std::vector<std::string> CommandWatch::Missed(double end) const {
  std::vector<std::string> missed;
  for (const Command& command : commands_) {
    if (command.is_done || !IsJudged(command, end)) continue;
    const StanceEvent& event = command.event;
    const std::string at = " at " + PrintNumber(event.at) + " s: ";
    const std::string foot = OneLine(event.foot);
    if (!command.has_begun) {
      missed.push_back("the command" + at + "the robot fell before");
    } else if (event.kind == Kind::kShift) {
      missed.push_back("shift to " + (foot.empty() ? "the middle" : foot) + at +
                       (command.way > 0
                            ? "the CoM stayed " + Millimeters(command.best) +
                                  " from its place, which is " +
                                  Millimeters(command.way) + " away"
                            : "the robot fell before its end"));
    } else if (event.kind == Kind::kLift) {
      missed.push_back("lift of " + foot + at + "the sole rose " +
                       Millimeters(command.best) + ", must rise " +
                       Millimeters(event.height));
    } else {
      missed.push_back("put_down of " + foot + at +
                       "the ground never pressed on the sole");
    }
  }
  if (IsMotionJudged(end) && MotionShare() < kMotionShare) {
    missed.push_back(
        "motion of the CoM: " + PrintNumber(std::round(100 * MotionShare())) +
        " % of what is commanded");
  }
  return missed;
}

}  // namespace poise
