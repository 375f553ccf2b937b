// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push_map/push_map_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/experiment.h"
#include "poise/sim/judge.h"
#include "poise/sim/push.h"
#include "poise/sim/yardstick.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/push/overrides.h"
#include "poise/tools/commands/push/push_options.h"
#include "poise/tools/commands/push/warnings.h"
#include "poise/tools/commands/user_path.h"

namespace poise {
namespace {

struct Shard {
  int index = 1;
  int count = 1;
};

Shard ParseShard(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  if (index.ec == std::errc() && index.ptr < end && *index.ptr == '/') {
    const auto count = std::from_chars(index.ptr + 1, end, shard.count);
    if (count.ec == std::errc() && count.ptr == end && shard.index >= 1 &&
        shard.index <= shard.count) {
      return shard;
    }
  }
  throw std::invalid_argument("--shard is '" + text +
                              "', must be I/N with 1 <= I <= N");
}

// Rejects a push without a bound, at which the search would start.
void RequireBound(const Experiment& experiment) {
  const Robot& robot = experiment.robot;
  const PushOnRobot push(robot, experiment.scenario.pushes[0]);
  if (ComputeYardstick(robot, robot.q_nominal, Eigen::Vector2d::UnitX(), 0,
                       push.body(), push.p_BoQ_B())) {
    return;
  }
  throw std::invalid_argument(
      "--point: the push is below the soles, must be above them, because the "
      "search starts at the pendulum's bound");
}

// Rejects runs that end too soon after the push to tell whether the robot
// recovers.
void RequireTimeToRecover(const Scenario& scenario,
                          const std::vector<double>& durations) {
  const double longest = *std::max_element(durations.begin(), durations.end());
  const double least = scenario.pushes[0].start + longest + Judge::kEnd;
  if (scenario.duration >= least) return;
  throw std::invalid_argument(
      "--durations has " + PrintNumber(longest) + " s, and a run lasts " +
      PrintNumber(scenario.duration) + " s, must last at least " +
      PrintNumber(least) + " s: the outcome is known " +
      PrintNumber(Judge::kEnd) + " s after the push; give --time");
}

// Returns a validator for a range. CLI::Range accepts NaN and prints numbers
// with too many digits.
CLI::Validator Between(double least, double most, const std::string& unit) {
  const auto check = [=](const std::string& text) -> std::string {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    if (read.ec == std::errc() && read.ptr == end && value >= least &&
        value <= most) {
      return "";
    }
    return "is " + Quoted(text) + ", must be " + PrintNumber(least) + " to " +
           PrintNumber(most) + " " + unit;
  };
  return CLI::Validator(check, "");
}

// Returns the points of a shard: every count-th point, in the order of the map.
std::vector<PushMapPoint> Points(int directions,
                                 const std::vector<double>& durations,
                                 const std::string& tasks, const Shard& shard) {
  std::vector<PushMapPoint> points;
  int count = 0;
  for (const double duration : durations) {
    for (int i = 0; i < directions; ++i) {
      if (count++ % shard.count != shard.index - 1) continue;
      points.push_back({360.0 * i / directions, duration, tasks});
    }
  }
  return points;
}

// Reads the options of `push`, with `push_map` as the name of the program.
PushOptions ReadRest(std::vector<std::string> arguments) {
  for (const char* taken :
       {"--force", "--impulse-fraction", "--direction", "--duration",
        "--pushes", "--scenario", "--no-report"}) {
    for (const std::string& argument : arguments) {
      if (argument.rfind(taken, 0) == 0 &&
          (argument.size() == std::string(taken).size() ||
           argument[std::string(taken).size()] == '=')) {
        throw std::invalid_argument(
            argument +
            " cannot be used here: push_map sets "
            "scenario, direction, duration and force itself");
      }
    }
  }
  arguments.insert(arguments.begin(), "push_map");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  return ReadPushOptions(static_cast<int>(argv.size()), argv.data());
}

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word + '\n';
  return text;
}

}  // namespace

PushMapOptions ReadPushMapOptions(int argc, char** argv) {
  int directions = 16;
  std::vector<double> durations = {0.1};
  std::vector<std::string> with, without;
  std::string shard_text = "1/1", out;
  int threads = static_cast<int>(std::thread::hardware_concurrency());
  bool no_replays = false;
  double step = 0.25;
  bool steps = false;
  bool json = false;
  CLI::App app(
      "Finds the largest impulse that the robot recovers from, in each "
      "direction. Run the same command again to continue after an "
      "interruption. A second set of tasks is added to the same map. Other "
      "options are those of push.",
      "push_map");
  app.allow_extras();
  app.add_option("--directions", directions,
                 "number of directions around the circle")
      ->capture_default_str()
      ->check(CLI::Range(1, 3600));
  app.add_option("--durations", durations, "durations of the push, S,... in s")
      ->delimiter(',')
      ->capture_default_str()
      ->check(Between(1e-3, 10, "s"));
  app.add_option("--with", with, "tasks to switch on")->delimiter(',');
  app.add_option("--without", without, "tasks to switch off")->delimiter(',');
  CLI::Option* step_option = app.add_option(
      "--step", step,
      "difference between successive impulses, N s (0.25; 0.5 with --steps)");
  step_option->check(Between(0.01, 100, "N s"));
  app.add_flag("--steps", steps,
               "let the robot take steps, and try every impulse from 2 N s to "
               "20 % beyond the first one without recovery");
  app.add_option("--shard", shard_text,
                 "I/N: compute every N-th point, from the I-th on");
  app.add_option("--jobs", threads,
                 "number of pushes simulated at the same time (all cores)")
      ->check(CLI::Range(1, 256));
  app.add_option(
      "--out", out,
      "folder (push-map-out; push-map-out/shard-I-of-N for a shard)");
  app.add_flag("--no-replays", no_replays, "do not write replay pages");
  app.add_flag("--json", json, "print the map as JSON");
  ParseCommandLine(argc, argv, &app);

  RefuseBoth(with, without);
  const Shard shard = ParseShard(shard_text);
  if (steps && step_option->count() == 0) step = 0.5;
  const std::vector<std::string> rest = app.remaining();
  const PushOptions push = ReadRest(rest);
  Experiment experiment{push.loop->robot(), push.loop->scenario()};
  PrintWarnings(push.robot_file.string(), experiment.robot, push.findings);
  if (steps) experiment.scenario.steps = true;
  ControlSettings& control = experiment.scenario.control;
  control.with.insert(control.with.end(), with.begin(), with.end());
  control.without.insert(control.without.end(), without.begin(), without.end());
  // An invalid experiment is rejected before the map's folder is made.
  const ClosedLoop valid(experiment.robot, experiment.scenario);
  RequireBound(experiment);
  RequireTimeToRecover(experiment.scenario, durations);
  if (out.empty()) {
    out = "push-map-out";
    if (shard.count > 1) {
      out += "/shard-" + std::to_string(shard.index) + "-of-" +
             std::to_string(shard.count);
    }
  }
  return {{std::move(experiment),
           Points(directions, durations, TaskSetName(with, without), shard),
           UserPath(out), std::max(1, threads), step, steps, !no_replays},
          "step " + std::to_string(step) + (steps ? " with steps\n" : "\n") +
              Joined(rest),
          shard.index == 1,
          json};
}

}  // namespace poise
