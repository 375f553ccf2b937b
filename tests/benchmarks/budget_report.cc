// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Compares answers of the solver with and without a budget, on ticks of closed
// loops without a budget. Ticks are solved warm, in their order. Also compares
// the gaps of pairs of answers with their true differences. Run with --help.
//   bazel run --config=opt //tests/benchmarks:budget_report
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "poise/robot/control/stand.h"
#include "poise/robot/profile/profile.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/sim/scenario.h"
#include "poise/tests/benchmarks/budget_sequence.h"
#include "poise/tests/benchmarks/gap_pairs.h"
#include "poise/tests/util/added_fingers.h"
#include "poise/tests/util/load_humanoid.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/package_path.h"
#include "poise/tools/commands/user_path.h"

namespace poise {
namespace {

constexpr const char* kProfile = "robot/profiles/humanoid.yaml";
constexpr double kForces[] = {0, 120, 300};  // Pushes of our humanoid, N.

struct Settings {
  BudgetOptions options;
  std::string only;
  std::vector<std::string> robots, packages;
  int pairs = 0;
  std::uint64_t seed = 1;
  bool ticks_that_differ = false;
};

Settings ReadOptions(int argc, char** argv) {
  Settings settings;
  CLI::App app("Compares answers of the solver with and without a budget.",
               "budget_report");
  app.footer(
      "Without --pairs and --ticks-that-differ, prints tables about recorded "
      "ticks. Measured times are CPU times of the thread.");
  app.option_defaults()->always_capture_default();
  app.add_option("--budget-us", settings.options.budget_us,
                 "Budget of a solve, modelled us")
      ->check(CLI::PositiveNumber);
  app.add_option("--repeats", settings.options.repeats,
                 "The measured time of a tick is the fastest of so many solves")
      ->check(CLI::PositiveNumber);
  app.add_option("--only", settings.only,
                 "Only the sequences whose name contains this text");
  app.add_option("--robot", settings.robots,
                 "URDF file of one more robot; a profile of the same name "
                 "ending in .yaml is used if there is one. May be given "
                 "several times")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  AddPackagePath(&app, &settings.packages);
  app.add_option("--pairs", settings.pairs,
                 "Compare the gaps of pairs of answers to so many random "
                 "hierarchies instead");
  app.add_option("--seed", settings.seed,
                 "Seed of the first random hierarchy; each further one adds 1");
  app.add_flag("--ticks-that-differ", settings.ticks_that_differ,
               "List the ticks at 5 % torque whose warm and cold answers "
               "differ instead");
  ParseCommandLine(argc, argv, &app);
  return settings;
}

// The ticks of hqp_benchmark with 5 % of the torque.
RecordingConditions LittleTorque() {
  RecordingConditions conditions;
  conditions.has_limits = true;
  conditions.torque_scale = 0.05;
  return conditions;
}

// Adds standing and the pushes, scaled to the mass of the robot, with limits.
void AddPushes(const std::string& name, const Robot& robot,
               std::vector<BudgetSequence>* sequences) {
  static const double our_mass = LoadHumanoid().model.tree.total_mass();
  const double ratio = robot.model.tree.total_mass() / our_mass;
  for (const double force : kForces) {
    RecordingConditions conditions;
    conditions.push_force = force * ratio;
    conditions.has_limits = true;
    conditions.robot = robot;
    std::ostringstream text;
    text << name << ", " << static_cast<int>(conditions.push_force + 0.5)
         << " N";
    sequences->push_back({text.str(), conditions});
  }
}

void AddScenario(const std::string& name,
                 std::vector<BudgetSequence>* sequences) {
  RecordingConditions conditions;
  conditions.scenario = LoadScenario("sim/scenarios/" + name + ".yaml");
  conditions.begin = 0;
  conditions.end = conditions.scenario->duration;
  sequences->push_back({name, conditions});
}

// Loads a robot with the profile beside its file, if there is one.
Robot Load(const std::filesystem::path& file, const Settings& settings) {
  std::filesystem::path profile = file;
  profile.replace_extension(".yaml");
  return MakeStandingRobot(
      UrdfDocument(file, nullptr, PackageFolders(settings.packages)),
      std::filesystem::exists(profile) ? LoadProfile(profile) : Profile{});
}

std::vector<BudgetSequence> MakeSequences(const Settings& settings) {
  std::vector<BudgetSequence> sequences;
  for (const bool has_limits : {false, true}) {
    for (const double force : kForces) {
      RecordingConditions conditions;
      conditions.push_force = force;
      conditions.has_limits = has_limits;
      sequences.push_back({std::to_string(static_cast<int>(force)) + " N" +
                               (has_limits ? " with limits" : ""),
                           conditions});
    }
  }
  sequences.push_back({"5 % torque", LittleTorque()});
  AddScenario("one_leg", &sequences);
  AddScenario("shove", &sequences);
  AddPushes("70 more fingers",
            MakeStandingRobot(AddFingers(7), LoadProfile(kProfile)),
            &sequences);
  for (const std::string& robot : settings.robots) {
    const std::filesystem::path file = UserPath(robot);
    AddPushes(file.stem().string(), Load(file, settings), &sequences);
  }
  return sequences;
}

int Main(int argc, char** argv) {
  const Settings settings = ReadOptions(argc, argv);
  if (settings.pairs > 0) {
    return CompareRandomPairs(settings.seed, settings.pairs) == 0 ? 0 : 1;
  }
  if (settings.ticks_that_differ) {
    PrintTicksThatDiffer(LittleTorque());
    return 0;
  }
  std::vector<BudgetResult> results;
  for (const BudgetSequence& sequence : MakeSequences(settings)) {
    if (sequence.name.find(settings.only) == std::string::npos) continue;
    std::cerr << sequence.name << std::endl;
    results.push_back(CompareBudget(sequence, settings.options));
  }
  PrintTables(std::move(results));
  return 0;
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::RunTool("budget_report",
                        [=] { return poise::Main(argc, argv); });
}
