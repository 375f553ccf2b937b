// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/studies/robot_trials.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "poise/robot/control/stand.h"
#include "poise/robot/feet/forward.h"
#include "poise/robot/feet/sole_source.h"
#include "poise/robot/finding.h"
#include "poise/robot/profile/find_profile.h"
#include "poise/robot/profile/profile.h"
#include "poise/robot/text_file.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/sim/experiment.h"
#include "poise/sim/log/parse_json.h"
#include "poise/sim/outcome.h"
#include "poise/sim/push.h"
#include "poise/sim/scenario.h"
#include "poise/tools/commands/doctor/one_leg.h"
#include "poise/tools/commands/push/warnings.h"
#include "poise/tools/studies/run_in_order.h"

namespace poise {
namespace {

namespace fs = std::filesystem;

constexpr double kPi = 3.14159265358979323846;
constexpr double kPushTime = 0.1;  // s.
constexpr double kStart = 1;       // Duration of a run with another seed, s.
constexpr double kPushRun = 4;     // Duration of a run with a push, s.

// Returns the URDF files of a folder in alphabetical order.
std::vector<fs::path> UrdfFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    if (entry.path().extension() == ".urdf") {
      files.push_back(fs::absolute(entry.path()));
    }
  }
  if (files.empty()) {
    throw std::invalid_argument(folder.string() +
                                ": must be a folder of URDF files");
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Returns where the soles come from. The worse of two origins counts.
std::string SolesFrom(const Robot& robot) {
  std::string from = "profile";
  for (const Foot& foot : robot.feet) {
    if (!foot.source) continue;
    if (*foot.source == SoleSource::kGuess) return "guess";
    from = *foot.source == SoleSource::kMesh ? "mesh" : "box";
  }
  return from;
}

bool IsBody(const Robot& robot, const Foot& foot, const std::string& link) {
  const auto frame = robot.model.tree.FindFrame(link);
  return frame && robot.model.tree.frames()[*frame].body == foot.body;
}

// Adds a fault for each foot or axis that is not the expected one.
void CompareFeet(const ExpectedRobot& expected, RobotTrial* trial) {
  const Robot& robot = *trial->robot;
  const std::pair<const char*, const std::string*> sides[] = {
      {"left", &expected.left_foot_link}, {"right", &expected.right_foot_link}};
  for (std::size_t i = 0; i < 2 && i < robot.feet.size(); ++i) {
    const auto& [side, link] = sides[i];
    if (link->empty() || IsBody(robot, robot.feet[i], *link)) continue;
    const int frame = robot.feet[i].frame;
    trial->faults.push_back(std::string(side) + " foot is " +
                            Quoted(robot.model.tree.frames()[frame].name) +
                            ", must be " + Quoted(*link));
  }
  if (!expected.forward.empty() && expected.forward != trial->forward) {
    trial->faults.push_back("forward is " + trial->forward + ", must be " +
                            expected.forward);
  }
}

// The runs of one robot.
class Candidate {
 public:
  Candidate(const fs::path& urdf, const std::vector<fs::path>& packages)
      : urdf_(urdf), packages_(packages) {
    trial_.name = urdf.stem().string();
  }

  // Runs the robot. `expected` is null if EXPECTED.json does not name it.
  //
  // @param may_be_refused  whether it is no fault if the robot is refused.
  RobotTrial Run(const ExpectedRobot* expected, bool may_be_refused) {
    may_be_refused_ = may_be_refused;
    const ExpectedRobot wanted = expected ? *expected : ExpectedRobot();
    try {
      Load();
      RunAll();
    } catch (const std::invalid_argument& error) {
      trial_.refused = OneLine(error.what());
      // The table is the same wherever the folder is.
      const std::string folder = urdf_.parent_path().string() + "/";
      if (trial_.refused.rfind(folder, 0) == 0) {
        trial_.refused.erase(0, folder.size());
      }
      trial_.robot.reset();
    }
    FindFaults(wanted);
    return std::move(trial_);
  }

  // Prints the warnings about the robot, after Run().
  void Warn(const RobotTrial& trial) const {
    if (trial.robot) PrintWarnings(urdf_.string(), *trial.robot, findings_);
  }

 private:
  // The one place where a robot of the folder is read. `packages_` are the
  // folders for its meshes.
  void Load() {
    const UrdfDocument document(urdf_, &findings_, packages_);
    const fs::path file = FindProfile(document.MakeModel().name, urdf_);
    const std::vector<Finding> findings = findings_;
    try {
      if (!file.empty()) profile_ = ReadProfile(file);
      trial_.profile = file.filename().string();
      trial_.robot = MakeStandingRobot(document, profile_, &findings_);
    } catch (const std::invalid_argument&) {
      // A profile of robot/profiles may be of another version of the robot.
      const bool is_ours = file.parent_path() != urdf_.parent_path();
      if (file.empty() || !is_ours) throw;
      profile_ = Profile();
      has_bad_profile_ = false;
      trial_.profile.clear();
      findings_ = findings;
      trial_.robot = MakeStandingRobot(document, profile_, &findings_);
    }
    trial_.soles = SolesFrom(*trial_.robot);
    trial_.forward = ForwardAxis(*trial_.robot);
  }

  // No robot is meant to have a profile that cannot be read.
  Profile ReadProfile(const fs::path& file) {
    has_bad_profile_ = true;
    Profile profile = LoadProfile(file);
    has_bad_profile_ = false;
    return profile;
  }

  RunResult RunScenario(const std::string& name,
                        const std::function<void(Scenario*)>& change) const {
    Scenario scenario = LoadScenario("sim/scenarios/" + name + ".yaml");
    UseTasksOf(profile_, &scenario);
    if (change) change(&scenario);
    return poise::Run(*trial_.robot, scenario);
  }

  RunResult RunPush(int degrees) const {
    return RunScenario("strong_push", [&](Scenario* scenario) {
      scenario->duration = kPushRun;
      Push& push = scenario->pushes.at(0);
      const double angle = degrees * kPi / 180;
      SetForce({std::cos(angle), std::sin(angle), 0}, &push);
      push.duration = kPushTime;
      push.impulse_fraction = kRobotsPush;
    });
  }

  void RunAll() {
    trial_.stand = RunScenario("stand", {});
    if (!trial_.stands()) return;
    for (unsigned seed = 2; seed <= RobotTrial::kSeeds; ++seed) {
      const RunResult start = RunScenario("stand", [&](Scenario* scenario) {
        scenario->duration = kStart;
        scenario->seed = seed;
      });
      if (start.verdict.fell_at) trial_.fallen_seeds.push_back(seed);
    }
    for (const int degrees : RobotTrial::kDirections) {
      trial_.pushes.push_back(RunPush(degrees));
    }
    for (const Finding& each : FindOneLegDefects(*trial_.robot)) {
      trial_.one_leg_obstacle += (trial_.one_leg_obstacle.empty() ? "" : "; ") +
                                 OneLine(each.where) + " " + OneLine(each.what);
    }
    trial_.one_leg = RunScenario("one_leg", {});
  }

  void FindFaults(const ExpectedRobot& wanted) {
    std::vector<std::string>& faults = trial_.faults;
    if (trial_.robot) CompareFeet(wanted, &trial_);
    if (has_bad_profile_) {
      faults.push_back("its profile is refused");
      return;
    }
    if (!wanted.stands) {
      if (trial_.stands()) faults.push_back("stands, must not");
      return;
    }
    if (!trial_.refused.empty()) {
      if (!may_be_refused_) faults.push_back("is refused");
      return;
    }
    if (!trial_.stands()) {
      faults.push_back("does not stand: " + Outcome(trial_.stand->verdict));
      return;
    }
    for (const unsigned seed : trial_.fallen_seeds) {
      faults.push_back("falls in stand with seed " + std::to_string(seed));
    }
    for (std::size_t i = 0; i < trial_.pushes.size(); ++i) {
      const Verdict& verdict = trial_.pushes[i].verdict;
      if (verdict.recovered) continue;
      faults.push_back("pushed to " +
                       std::to_string(RobotTrial::kDirections[i]) +
                       " deg: " + Outcome(verdict));
    }
    const RunResult& one_leg = *trial_.one_leg;
    const bool is_done =
        one_leg.verdict.recovered && one_leg.commanded_done.value_or(true);
    if (!is_done && trial_.one_leg_obstacle.empty()) {
      faults.push_back("one_leg: " + (one_leg.verdict.recovered
                                          ? "the motion did not happen"
                                          : Outcome(one_leg.verdict)));
    }
  }

  fs::path urdf_;
  std::vector<fs::path> packages_;
  std::vector<Finding> findings_;
  Profile profile_;
  bool has_bad_profile_ = false;
  bool may_be_refused_ = false;
  RobotTrial trial_;
};

// Throws if a robot of EXPECTED.json has no file, because it would not be
// tried.
void CheckNames(const std::map<std::string, ExpectedRobot>& expected,
                const std::vector<fs::path>& files) {
  for (const auto& [name, robot] : expected) {
    const auto found = std::find_if(
        files.begin(), files.end(),
        [name = name](const fs::path& file) { return file.stem() == name; });
    if (found != files.end()) continue;
    throw std::invalid_argument(
        (files[0].parent_path() / "EXPECTED.json").string() + ": robot " +
        Quoted(name) + " has no URDF file in the folder, add " + OneLine(name) +
        ".urdf or remove the key");
  }
}

std::string TextOrEmpty(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>()
                                                     : "";
}

}  // namespace

std::map<std::string, ExpectedRobot> ReadExpected(const fs::path& folder) {
  constexpr std::size_t kMostMiB = 16;
  const fs::path file = folder / "EXPECTED.json";
  std::error_code none;
  if (!fs::exists(file, none)) return {};
  std::map<std::string, ExpectedRobot> robots;
  try {
    const nlohmann::json json =
        ParseJson(ReadTextFile(file, kMostMiB), file.string());
    if (!json.is_object()) {
      throw std::invalid_argument(
          "must be an object with a key for each robot");
    }
    for (const auto& [name, entry] : json.items()) {
      const auto stands = entry.find("stands");
      if (!entry.is_object() || stands == entry.end() ||
          !stands->is_boolean()) {
        throw std::invalid_argument("robot " + Quoted(name) +
                                    ": must have stands: true or false");
      }
      robots[name] = {stands->get<bool>(), TextOrEmpty(entry, "left_foot_link"),
                      TextOrEmpty(entry, "right_foot_link"),
                      TextOrEmpty(entry, "forward")};
    }
  } catch (const Refusal&) {  // Already names the file.
    throw;
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(file.string() + ": " + error.what());
  }
  return robots;
}

std::vector<RobotTrial> RunRobots(
    const RobotFolder& robots,
    const std::function<void(const RobotTrial&)>& show) {
  const auto expected = ReadExpected(robots.folder);
  const bool expects_nothing = !fs::exists(robots.folder / "EXPECTED.json");
  const std::vector<fs::path> files = UrdfFiles(robots.folder);
  CheckNames(expected, files);
  std::deque<Candidate> candidates;
  std::vector<const ExpectedRobot*> wanted;
  for (const fs::path& file : files) {
    const std::string name = file.stem().string();
    if (name.find(robots.only) == std::string::npos) continue;
    candidates.emplace_back(file, robots.packages);
    const auto found = expected.find(name);
    wanted.push_back(found == expected.end() ? nullptr : &found->second);
  }
  if (candidates.empty()) {
    throw std::invalid_argument("--only is " + Quoted(robots.only) +
                                ", must be part of the name of a robot");
  }
  std::vector<RobotTrial> trials;
  RunInOrder(
      candidates.size(),
      [&](std::size_t i) {
        return candidates[i].Run(wanted[i], expects_nothing);
      },
      [&](std::size_t i, RobotTrial trial) {
        trials.push_back(std::move(trial));
        candidates[i].Warn(trials.back());
        show(trials.back());
      });
  return trials;
}

}  // namespace poise
