// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/studies/trials.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "poise/robot/finding.h"
#include "poise/robot/limits.h"
#include "poise/robot/numbers.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/observation.h"
#include "poise/sim/outcome.h"
#include "poise/sim/yardstick.h"
#include "poise/tools/commands/push/push_options.h"

namespace poise {
namespace {

using Bar = Trial::Bar;

constexpr double kSteadyError = 3e-3;  // m.
constexpr double kFlatFoot = 0.02;     // rad.
constexpr double kUprightLean = 0.02;  // rad.
// By how much the lean of a later time may be above that of an earlier one.
constexpr double kNoGrowth = 1e-3;  // rad.

// Of what a pendulum on a robot's feet takes, over this time: sideways, by any
// robot; in every direction, by ours.
constexpr double kRobotsPush = 0.4;
constexpr double kOurPush = 0.9;
constexpr double kPushTime = 0.1;  // s.
constexpr int kDirections = 16;

std::vector<std::string> Words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

Trial Make(const std::string& what, const std::string& options,
           Bar bar = Bar::kRecovers) {
  return {what, Words(options), bar};
}

PushOptions Read(const std::vector<std::string>& options) {
  std::vector<std::string> words = options;
  words.insert(words.begin(), "push");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  return ReadPushOptions(static_cast<int>(argv.size()), argv.data());
}

// The paper's scenarios at another rate of control.
void AddRate(const std::string& rate, std::vector<Trial>* trials) {
  const std::string at = " --control-rate " + rate;
  const std::string hz = rate + " Hz: ";
  for (const char* name :
       {"stand", "posture_off", "com_sinusoid", "weak_push", "strong_push"}) {
    trials->push_back(Make(hz + name, "--scenario " + std::string(name) + at));
  }
  trials->push_back(Make(hz + "strong_push_without_zmp",
                         "--scenario strong_push_without_zmp" + at,
                         Bar::kFalls));
  trials->push_back(
      Make(hz + "figure 12",
           "--scenario strong_push --with zmp --duration 0.12" + at,
           Bar::kRecovers));
}

// In alphabetical order.
std::vector<std::filesystem::path> UrdfFiles(
    const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    if (entry.path().extension() == ".urdf") {
      files.push_back(std::filesystem::absolute(entry.path()));
    }
  }
  if (files.empty()) {
    throw std::invalid_argument(folder.string() +
                                ": must be a folder of URDF files");
  }
  std::sort(files.begin(), files.end());
  return files;
}

// What a robot is called, and its profile; empty: it is to be found.
std::pair<std::string, std::filesystem::path> NameAndProfile(
    const std::filesystem::path& urdf) {
  const std::pair<const char*, const char*> ours[] = {
      {"talos_reduced", "talos"},   {"jvrc1", "jvrc1"},
      {"icub_erd_reduced", "icub"}, {"hrp4c", "hrp4c"},
      {"atlas", "atlas"},           {"booster_t1", "t1"},
      {"draco3", "draco3"},         {"g1_29dof", "g1"}};
  const std::string stem = urdf.stem().string();
  const std::filesystem::path beside =
      std::filesystem::path(urdf).replace_extension(".yaml");
  if (std::filesystem::exists(beside)) return {stem, beside};
  for (const auto& [name, profile] : ours) {
    if (stem != name) continue;
    return {profile, std::filesystem::absolute(std::string("robot/profiles/") +
                                               profile + ".yaml")};
  }
  return {stem, {}};
}

// What a pendulum on the robot's feet takes of its first push, N.
double PendulumForce(const PushOptions& read) {
  const Push& push = read.scenario.pushes[0];
  const PushOnRobot aimed(read.robot, push);
  const Eigen::Vector2d u = push.force.head<2>();
  return ComputeYardstick(read.robot, read.robot.q_nominal, u, kPushTime,
                          aimed.body(), aimed.p_BoQ_B())
             .lipm_Ns /
         kPushTime;
}

// Throws where its robot cannot be had; says what doctor would warn of. A push
// becomes as strong as its robot is to bear.
void Aim(Trial* trial) {
  const PushOptions read = Read(trial->options);
  Warn(read);
  if (read.scenario.pushes.empty()) return;
  trial->options[3] = std::to_string(kRobotsPush * PendulumForce(read));
}

void AddDirections(std::vector<Trial>* trials) {
  for (int k = 0; k < kDirections; ++k) {
    std::ostringstream direction;
    direction << 360. * k / kDirections;
    Trial trial =
        Make("0.9 of a pendulum's push at " + direction.str() + " degrees",
             "--scenario strong_push --force 1 --duration " +
                 std::to_string(kPushTime) + " --time 5 --direction " +
                 direction.str());
    trial.options[3] =
        std::to_string(kOurPush * PendulumForce(Read(trial.options)));
    trials->push_back(trial);
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

// A word of a command as a person would write it: a file without its folder, a
// number to six digits.
std::string Shortened(const std::string& word) {
  const std::filesystem::path path = word;
  if (path.is_absolute()) return path.filename().string();
  const auto numbers = ParseNumbers(word);
  return numbers && numbers->size() == 1 ? PrintNumber(numbers->front()) : word;
}

}  // namespace

std::vector<Trial> RobustnessTrials() {
  const std::string strong = "--scenario strong_push --time 8";
  std::vector<Trial> trials = {
      Make("nothing wrong", strong, Bar::kSteady),
      Make("model 10 % too heavy", strong + " --mass-error 0.1", Bar::kSteady),
      Make("model 10 % too light", strong + " --mass-error -0.1", Bar::kSteady),
      Make("delay of 2 ms", strong + " --delay 0.002"),
      Make("delay of 5 ms", strong + " --delay 0.005"),
      Make("noise: 2 mrad, 0.1 rad/s", strong + " --noise 1"),
      Make("noise, another seed", strong + " --noise 1 --seed 2"),
      Make("noise, a third seed", strong + " --noise 1 --seed 3"),
      Make("friction 0.3 in the plant", strong + " --mu-plant 0.3"),
      Make("torque limits halved", strong + " --torque-scale 0.5"),
      Make("sensors frozen for 20 ms", strong + " --freeze 1.05,0.02")};
  const std::string all =
      "--scenario weak_push --delay 0.002 --noise 1 --mu-plant 0.3 ";
  trials.push_back(Make("all of it, too heavy", all + "--mass-error 0.1"));
  trials.push_back(Make("all of it, too light", all + "--mass-error -0.1"));
  for (const char* name : {"stand", "weak_push", "strong_push"}) {
    trials.push_back(Make("base estimated: " + std::string(name),
                          "--estimator --scenario " + std::string(name)));
  }
  trials.push_back(Make("the sinusoid for 64 s",
                        "--scenario com_sinusoid --time 64", Bar::kUpright));
  trials.push_back(Make("50 N for 0.4 s", strong + " --force 50 --duration 0.4",
                        Bar::kFlat));
  trials.push_back(Make("100 N for 0.2 s",
                        strong + " --force 100 --duration 0.2", Bar::kFlat));
  for (const char* rate : {"500", "200", "100"}) AddRate(rate, &trials);
  AddDirections(&trials);
  return trials;
}

std::vector<Trial> RobotTrials(const std::filesystem::path& robots,
                               const std::string& only,
                               std::vector<std::string>* skipped) {
  std::vector<Trial> trials;
  for (const std::filesystem::path& file : UrdfFiles(robots)) {
    const auto [name, profile] = NameAndProfile(file);
    std::vector<std::string> robot = {"--robot", file.string()};
    if (!profile.empty()) {
      robot.insert(robot.end(), {"--profile", profile.string()});
    }
    Trial stand = Make(name + " stands", "--scenario stand");
    Trial push =
        Make(name + ", pushed", "--scenario strong_push --force 1 --duration " +
                                    std::to_string(kPushTime));
    std::vector<Trial> both;
    for (Trial* trial : {&stand, &push}) {
      if (trial->what.find(only) == std::string::npos) continue;
      trial->options.insert(trial->options.end(), robot.begin(), robot.end());
      both.push_back(*trial);
    }
    if (both.empty()) continue;
    try {
      Aim(&both.back());
    } catch (const std::invalid_argument& error) {
      skipped->push_back(file.filename().string() +
                         " is skipped: " + OneLine(error.what()));
      continue;
    }
    trials.insert(trials.end(), both.begin(), both.end());
  }
  return trials;
}

TrialResult Try(const Trial& trial) {
  const PushOptions options = Read(trial.options);
  const Scenario& scenario = options.scenario;
  ClosedLoop loop(options.robot, scenario);
  Judge judge(StandingHeight(options.robot));
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
    result.joint_violation =
        std::max(result.joint_violation,
                 JointViolation(options.robot.model, record.end.q));
  }
  result.verdict = judge.Conclude();
  result.holds = Holds(trial.bar, result);
  return result;
}

std::string ToRow(const Trial& trial, const TrialResult& result) {
  std::string options;
  for (const std::string& word : trial.options) {
    options += (options.empty() ? "" : " ") + Shortened(word);
  }
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
  return "| " + trial.what + " | `" + options + "`" + text;
}

}  // namespace poise
