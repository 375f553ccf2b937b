// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push/push_options.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "poise/robot/control/default_stack.h"
#include "poise/robot/control/stand.h"
#include "poise/robot/control/task_set.h"
#include "poise/robot/finding.h"
#include "poise/robot/input_error.h"
#include "poise/robot/mesh/read_visuals.h"
#include "poise/robot/profile/profile.h"
#include "poise/robot/profile/save_profile.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/experiment.h"
#include "poise/sim/yaml_fields.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/keep_inputs.h"
#include "poise/tools/commands/package_path.h"
#include "poise/tools/commands/push/overrides.h"
#include "poise/tools/commands/user_path.h"

namespace poise {

namespace {

constexpr const char* kRobot = "robot/models/humanoid.urdf";
constexpr const char* kProfile = "robot/profiles/humanoid.yaml";
constexpr const char* kScenarios = "sim/scenarios";

// The options that choose the files and the outputs of a run.
struct Files {
  std::string scenario = "strong_push", robot, profile, save_profile, out,
              log = "csv";
  std::vector<std::string> packages;
  std::optional<double> dump_solve, dump_from;
  bool no_report = false, json = false;
};

// The files of an experiment, and the sizes of the scenario's lists before
// options are applied.
struct Sources {
  std::string robot, scenario, pushes;  // File names, or empty.
  std::size_t num_pushes = 0, num_with = 0, num_without = 0;
};

std::string Entry(const char* list, std::size_t i) {
  return std::string(list) + "[" + std::to_string(i) + "]";
}

// Returns the option that gave a field its value, or an empty string.
std::string OptionOf(const std::string& field, const Overrides& o,
                     const Sources& sources) {
  const std::tuple<bool, const char*, const char*> options[] = {
      {o.time.has_value(), "duration", "--time"},
      {o.control_rate.has_value(), "control.rate", "--control-rate"},
      {o.plant_rate.has_value(), "plant.rate", "--plant-rate"},
      // A budget by the clock needs --budget-us as well.
      {o.budget_us.has_value() || o.budget_clock.has_value(),
       "control.budget_us", "--budget-us"},
      {o.budget_clock.has_value(), "control.budget_clock", "--budget-clock"},
      {o.delay.has_value(), "control.delay", "--delay"},
      {o.ramp.has_value(), "control.ramp", "--ramp"},
      {o.mass_error.has_value(), "control.mass_error", "--mass-error"},
      {o.mu_plant.has_value(), "plant.friction", "--mu-plant"},
      {o.torque_scale.has_value(), "plant.torque_scale", "--torque-scale"},
      {o.noise.has_value(), "sensors.noise", "--noise"},
      {!o.freeze.empty(), "sensors.freeze_at", "--freeze"},
      {!o.freeze.empty(), "sensors.freeze_for", "--freeze"},
      {o.force.has_value(), "pushes[0].force", "--force"},
      {o.impulse_fraction.has_value(), "pushes[0].impulse_fraction",
       "--impulse-fraction"},
      {o.duration.has_value(), "pushes[0].duration", "--duration"},
      {o.at.has_value(), "pushes[0].at", "--at"},
      {!o.point.empty(), "pushes[0].point", "--point"},
      {o.link.has_value(), "pushes[0].link", "--link"},
      {o.direction.has_value(), "direction", "--direction"},
      {o.tasks.has_value(), "tasks.set", "--tasks"}};
  for (const auto& [is_given, setting, option] : options) {
    if (is_given && field == setting) return option;
  }
  // Tasks from options follow the tasks from the scenario file.
  for (std::size_t i = 0; i < o.with.size(); ++i) {
    if (field == Entry("tasks.with", sources.num_with + i)) return "--with";
  }
  for (std::size_t i = 0; i < o.without.size(); ++i) {
    if (field == Entry("tasks.without", sources.num_without + i)) {
      return "--without";
    }
  }
  return "";
}

// Returns the file that gave a field its value, or an empty string.
std::string FileOf(const std::string& field, const Sources& sources) {
  if (field == "robot") return sources.robot;
  if (field.rfind("pushes", 0) != 0) return sources.scenario;
  if (!sources.pushes.empty()) return sources.pushes;
  return sources.num_pushes > 0 ? sources.scenario : "";
}

// Returns the message of an error, with the option or the file that has the
// invalid value.
std::string Blame(const InputError& error, const Overrides& o,
                  const Sources& sources) {
  bool is_by_option = false;
  const auto name = [&](const std::string& field) {
    const std::string option = OptionOf(field, o, sources);
    return option.empty() ? field : option;
  };
  for (const std::string& field : {error.field(), error.other()}) {
    is_by_option |= !OptionOf(field, o, sources).empty();
  }
  const std::string file = FileOf(error.field(), sources);
  if (is_by_option || file.empty()) return error.Say(name);
  int line = 0;
  if (file != sources.robot) {  // A URDF file is not YAML.
    line = LineOf(file, error.field());
    if (line == 0 && !error.other().empty()) line = LineOf(file, error.other());
  }
  return file + ":" + (line > 0 ? std::to_string(line) + ":" : "") + " " +
         error.Say(name);
}

// Returns the names of Poise's scenarios in alphabetical order.
std::string ScenarioNames() {
  std::set<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(kScenarios)) {
    names.insert(file.path().stem().string());
  }
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

// Returns the file of a scenario of Poise with this name, or else the user's
// file with this name. Throws std::invalid_argument if neither exists.
std::filesystem::path FindScenario(const std::string& name) {
  std::error_code too_long;  // Too long for the name of a file.
  if (name.find('/') == std::string::npos) {
    const std::filesystem::path ours =
        std::filesystem::path(kScenarios) / (name + ".yaml");
    if (std::filesystem::exists(ours, too_long)) return ours;
  }
  std::filesystem::path theirs = UserPath(name);
  if (std::filesystem::exists(theirs, too_long)) return theirs;
  throw std::invalid_argument("scenario '" + name +
                              "' is unknown, must be a file or one of " +
                              ScenarioNames());
}

// Reads the command line. Throws as ParseCommandLine() does.
Files ParseOptions(int argc, char** argv, Overrides* overrides) {
  Files files;
  CLI::App app(
      "Pushes a humanoid in a simulation and reports whether it recovers.",
      "push");
  app.footer("Scenarios: " + ScenarioNames() +
             ".\nAn option about the push adds one, of 50 N to the left, to a "
             "scenario without pushes.\nTasks: see docs/tasks.md. Exit code 0: "
             "the robot recovered; "
             "1: it did not recover; 2: bad input.");
  app.add_option("--scenario", files.scenario,
                 "name of a scenario, or a YAML file")
      ->capture_default_str();
  app.add_option("--robot", files.robot,
                 "URDF file of the robot (Poise's humanoid)");
  app.add_option("--profile", files.profile,
                 "YAML file with feet, posture and tasks of the robot");
  AddPackagePath(&app, &files.packages);
  app.add_option("--save-profile", files.save_profile,
                 "write the profile in use to this file, with the feet and "
                 "posture that Poise found");
  AddOptions(&app, overrides);
  app.add_option("--out", files.out,
                 "folder to write into, where the files of an earlier run are "
                 "replaced (push-out/SCENARIO)");
  app.add_option("--log", files.log,
                 "csv writes log.csv; binary writes log.bin, for long runs")
      ->check(CLI::IsMember({"csv", "binary"}))
      ->capture_default_str();
  CLI::Option* const dump = app.add_option(
      "--dump-solve", files.dump_solve,
      "write the hierarchy solved at this time, s, so that hqp can solve it "
      "again");
  dump->check(CLI::Range(0.0, 1e6));
  app.add_option("--dump-from", files.dump_from,
                 "with --dump-solve: write those of all ticks from this time "
                 "on; from 0 on, hqp repeats solves with a budget, too, "
                 "but for --budget-clock")
      ->check(CLI::Range(0.0, 1e6))
      ->needs(dump);
  app.add_flag("--no-report", files.no_report, "do not write report.html");
  app.add_flag("--json", files.json, "print summary.json on stdout");
  ParseCommandLine(argc, argv, &app);
  return files;
}

// Loads the profile that the options name. Only Poise's humanoid has a default
// profile.
Profile ChooseProfile(const Files& files) {
  if (!files.profile.empty()) return LoadProfile(UserPath(files.profile));
  if (files.robot.empty()) return LoadProfile(kProfile);
  return {};
}

std::optional<DumpedTicks> Dumped(const Files& files) {
  if (!files.dump_solve) return {};
  return DumpedTicks{files.dump_from.value_or(*files.dump_solve),
                     *files.dump_solve};
}

// Writes the profile that the run uses, with its locked joints and its tasks.
void SaveFullProfile(const Robot& standing, const UrdfDocument& urdf,
                     Profile profile, const std::string& name) {
  // The angles of mimic joints depend on their source joints before the robot
  // stands up, so they come from a new model.
  profile.locked = LockedJoints(urdf.MakeModel(), profile);
  if (!profile.tasks.IsDefined()) {
    profile.tasks = DescribeTasks(MakeDefaultStack(standing, {}));
  }
  SaveProfile(standing, profile, UserPath(name));
}

}  // namespace

PushOptions ReadPushOptions(int argc, char** argv) {
  if (!std::filesystem::is_directory(kScenarios)) {
    throw std::invalid_argument(
        std::string(kScenarios) +
        " is missing: start the command by `bazel run`, "
        "or in the folder of the sources");
  }
  Overrides overrides;
  const Files files = ParseOptions(argc, argv, &overrides);
  const std::filesystem::path scenario_file = FindScenario(files.scenario);
  const std::filesystem::path robot_file =
      files.robot.empty() ? kRobot : UserPath(files.robot);
  Scenario scenario = ReadScenario(scenario_file);
  const Sources sources{
      robot_file.string(),
      scenario_file.string(),
      overrides.pushes ? UserPath(*overrides.pushes).string() : "",
      scenario.pushes.size(),
      scenario.control.with.size(),
      scenario.control.without.size()};
  std::vector<Finding> findings;
  std::unique_ptr<ClosedLoop> loop;
  try {
    Apply(overrides, &scenario);
    KeepInputs(files.save_profile,
               {{robot_file, "the robot's file"},
                {scenario_file, "the scenario's file"},
                {sources.pushes, "the file of pushes"},
                {scenario.control.tasks, "the task set"},
                {files.profile.empty() ? "" : UserPath(files.profile),
                 "the profile that is read"}});
    const Profile profile = ChooseProfile(files);
    // `--tasks default` selects the default tasks even if the profile has
    // tasks.
    if (!overrides.tasks) UseTasksOf(profile, &scenario);
    const UrdfDocument urdf(robot_file, &findings,
                            PackageFolders(files.packages));
    Robot robot = MakeStandingRobot(urdf, profile, &findings);
    if (!files.no_report) ReadVisuals(&robot.model);
    loop = std::make_unique<ClosedLoop>(robot, scenario);
    if (!files.save_profile.empty()) {
      SaveFullProfile(robot, urdf, profile, files.save_profile);
    }
  } catch (const InputError& error) {
    throw std::invalid_argument(Blame(error, overrides, sources));
  }
  return {std::move(loop),
          robot_file,
          UserPath(files.out.empty() ? "push-out/" + scenario.name : files.out),
          files.log == "binary" ? LogFormat::kBinary : LogFormat::kCsv,
          Dumped(files),
          !files.no_report,
          files.json,
          std::move(findings)};
}

}  // namespace poise
