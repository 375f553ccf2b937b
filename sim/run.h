// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "poise/robot/control/stack.h"
#include "poise/robot/robot.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/judge.h"
#include "poise/sim/log/log_rows.h"
#include "poise/sim/log/recorder.h"
#include "poise/sim/scenario.h"
#include "poise/sim/step_watch.h"
#include "poise/sim/yardstick.h"

namespace poise {

/// The distribution of times over the ticks of a run, us.
struct TickTimes {
  double median = 0;
  double p99 = 0;
  double p999 = 0;
  double max = 0;
};

/// Outcome and cost of a run.
struct RunResult {
  Verdict verdict;
  /// Set if a joint was flung off before the robot fell: which joint, in words.
  /// A body does not do so by itself, so the cause is the controller or the
  /// plant.
  std::string blew_up;
  double duration = 0;  ///< Simulated time, s; shorter after a fall.
  bool interrupted = false;
  long ticks = 0;
  TickTimes tick_us;      ///< Computing time of the controller.
  TickTimes modelled_us;  ///< Solver::modelled_seconds().
  int iterations_max = 0;
  double certificate_max = 0;  ///< Largest of all ticks, hqp/certificate.h.
  double gap_max = 0;  ///< Largest Certificate::relative_gap of all ticks.
  int failures = 0;    ///< Ticks with TickStatus kTruncated or kFailSafe.
  double joint_limit_violation_peak = 0;   ///< rad or m.
  double torque_limit_violation_peak = 0;  ///< N m or N.
  int self_contact_ticks = 0;
  double impulse_Ns = 0;     ///< Largest push, part within the run.
  double push_duration = 0;  ///< Largest push, s.
  /// Pendulum bound in the direction of the largest push, on the feet that are
  /// down when the push begins. Empty if the push does not begin, or as
  /// BoundOfPush().
  std::optional<Yardstick> yardstick;
  std::vector<TakenStep> steps;  ///< In order of their lift-offs.
  std::vector<CommandedStep> commanded;
  /// Whether each commanded motion happened: see CommandWatch, and each step
  /// was accepted and has landed within 10 mm of its place. False if there is
  /// anything in ClosedLoop::impossible(). Empty without a command and that.
  std::optional<bool> commanded_done;
  /// The commanded steps that did not happen, CommandWatch::Missed() and
  /// ClosedLoop::impossible(), in words.
  std::vector<std::string> not_done;
  double wall_seconds = 0;
  std::string log_sha256;  ///< Empty if nothing was recorded.
  /// Rows of the stack that the log names; empty if nothing was recorded.
  std::vector<StackRow> rows;
};

/// Returns the cause of the fall in words; empty without a fall.
std::string FellBy(const RunResult& result);

/// Returns the time from the end of the last push to the end of the run, s, if
/// it is shorter than Judge::kEnd. The judged interval then has time of the
/// push or before it, so the run is too short to show that the robot recovered.
std::optional<double> TooShortAfterPushes(const Scenario& scenario,
                                          const RunResult& result);

/// Runs a new loop to the end of its scenario, or until Judge::is_down().
///
/// @param folder    folder in which a Recorder writes; empty: nothing is
///                  written.
/// @param format    of the log, see Recorder.
/// @param progress  called a hundred times or more with the fraction done;
///                  stops the run by returning false. May be empty.
///
/// The robot has not recovered if TooShortAfterPushes().
///
/// Throws std::invalid_argument as Recorder does.
RunResult Run(ClosedLoop* loop, const std::filesystem::path& folder = {},
              const std::function<bool(double)>& progress = {},
              LogFormat format = LogFormat::kCsv);

/// Runs a new loop of a robot and a scenario. Throws also as ClosedLoop does.
RunResult Run(const Robot& robot, const Scenario& scenario,
              const std::filesystem::path& folder = {},
              const std::function<bool(double)>& progress = {},
              LogFormat format = LogFormat::kCsv);

}  // namespace poise
