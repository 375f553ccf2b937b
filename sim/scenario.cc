// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/scenario.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/input_error.h"
#include "poise/robot/profile/yaml_file.h"
#include "poise/sim/number_field.h"
#include "poise/sim/plants/make_plant.h"
#include "poise/sim/scenario_fields.h"
#include "poise/sim/yaml_fields.h"

namespace poise {

namespace {

constexpr double kMostTicks = 1e8;
constexpr double kMostStepsInATick = 1000;
constexpr std::size_t kMostEntries = 1000;  // Largest list.

template <typename Settings>
void ReadNumbers(YamlFields fields, Settings* settings) {
  fields.Read(Fields(settings));
  fields.Finish();
}

Push ReadPush(YamlFields fields) {
  Push push;
  push.link = fields.Text("link", push.link);
  if (fields.Has("point")) push.point.emplace();
  if (fields.Has("impulse_fraction")) push.impulse_fraction.emplace();
  if (fields.Has("elsewhere")) push.elsewhere.emplace();
  const std::string frame = fields.Text("frame", "world");
  if (frame == "link") {
    push.frame = PushFrame::kLink;
  } else if (frame != "world") {
    fields.Refuse("frame", "must be world or link");
  }
  const std::string name = fields.Text("profile", NameOf(push.profile));
  bool is_known = false;
  for (const PushProfile profile :
       {PushProfile::kBox, PushProfile::kHalfSine, PushProfile::kImpulse}) {
    if (name != NameOf(profile)) continue;
    push.profile = profile;
    is_known = true;
  }
  if (!is_known) {
    fields.Refuse("profile", "must be box, half_sine or impulse");
  }
  fields.Read(Fields(&push));
  fields.Finish();
  return push;
}

// A fraction of a bound needs a horizontal direction in the world.
void CheckFraction(const std::string& push, const Push& of) {
  if (!of.impulse_fraction && !of.elsewhere) return;
  const bool has_direction = of.frame == PushFrame::kWorld &&
                             of.moment.isZero() && of.force.z() == 0 &&
                             !of.force.isZero();
  if (has_direction) return;
  throw InputError(
      push + (of.impulse_fraction ? ".impulse_fraction" : ".elsewhere"),
      "a fraction of the bound must come with a horizontal force, "
      "without moment, in the frame world");
}

// Returns the place of a step.
Eigen::Vector2d ReadPlace(YamlFields* fields) {
  constexpr double kFarthest = 1e3;  // m.
  const std::vector<double> place = fields->Numbers("to");
  const bool is_place = place.size() == 2 &&
                        std::all_of(place.begin(), place.end(), [](double x) {
                          return std::abs(x) <= kFarthest;
                        });
  if (!is_place) {
    fields->Refuse("to", "must be two numbers [x, y] from -1000 to 1000 m");
  }
  return {place[0], place[1]};
}

StanceEvent ReadStanceEvent(YamlFields fields) {
  StanceEvent event;
  const std::string lift = fields.Text("lift", "");
  const std::string put_down = fields.Text("put_down", "");
  const std::string shift = fields.Text("shift", "");
  const std::string step = fields.Text("step", "");
  if (!step.empty()) event.to = ReadPlace(&fields);
  fields.Read(Fields(&event));
  fields.Finish();
  for (const auto& [key, other] :
       {std::pair("lift", "put_down"), std::pair("lift", "shift"),
        std::pair("put_down", "shift"), std::pair("step", "lift"),
        std::pair("step", "put_down"), std::pair("step", "shift")}) {
    if (!fields.Has(key) || !fields.Has(other)) continue;
    fields.Refuse(key, "must not be in one entry with " + std::string(other) +
                           ": write two entries");
  }
  for (const auto& [key, action] :
       {std::pair("over", "shift"), std::pair("height", "lift")}) {
    const bool has_action = fields.Has("lift") || fields.Has("put_down") ||
                            fields.Has("shift") || fields.Has("step");
    if (!has_action || !fields.Has(key) || fields.Has(action)) continue;
    fields.Refuse(key, "must come with " + std::string(action) + " only");
  }
  if (!lift.empty()) {
    event.kind = StanceEvent::Kind::kLift;
    event.foot = lift;
  } else if (!put_down.empty()) {
    event.kind = StanceEvent::Kind::kPutDown;
    event.foot = put_down;
  } else if (!shift.empty()) {
    event.foot = shift == "middle" ? "" : shift;
  } else if (!step.empty()) {
    event.kind = StanceEvent::Kind::kStep;
    event.foot = step;
  } else {
    fields.Refuse("at", "must come with lift, put_down, shift or step");
  }
  return event;
}

void ReadTasks(YamlFields fields, ControlSettings* control) {
  control->tasks = fields.Text("set", control->tasks);
  control->with = fields.Words("with");
  control->without = fields.Words("without");
  fields.Finish();
}

unsigned ReadSeed(YamlFields* fields, unsigned otherwise) {
  const double seed = fields->Number("seed", otherwise);
  if (!(seed >= 0 && seed <= std::numeric_limits<unsigned>::max() &&
        seed == std::floor(seed))) {
    fields->Refuse("seed", "must be a whole number from 0 to 2^32 - 1");
  }
  return static_cast<unsigned>(seed);
}

void ReadControl(YamlFields fields, ControlSettings* control) {
  fields.Read(Fields(control));
  control->inscribed = fields.Flag("inscribed", control->inscribed);
  control->feedforward = fields.Flag("feedforward", control->feedforward);
  control->weighted = fields.Flag("weighted", control->weighted);
  control->estimator = fields.Flag("estimator", control->estimator);
  control->budget_clock = fields.Flag("budget_clock", control->budget_clock);
  control->drag_compensation =
      fields.Flag("drag_compensation", control->drag_compensation);
  fields.Finish();
}

void ReadPlant(YamlFields fields, Scenario* scenario) {
  PlantSettings& plant = scenario->plant;
  scenario->plant_kind = fields.Text("kind", scenario->plant_kind);
  if (!IsPlant(scenario->plant_kind)) {
    fields.Refuse("kind", "must be " + PlantNamesInWords());
  }
  fields.Read(Fields(&plant));
  for (YamlFields& board : fields.Maps("boards")) {
    plant.ground.boards.push_back(
        {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
    board.Read(Fields(&plant.ground.boards.back()));
    board.Finish();
    if (!board.Has("size")) {
      board.Refuse("size", "must be a list of 3 numbers, m");
    }
  }
  plant.joint_limits = fields.Flag("joint_limits", plant.joint_limits);
  plant.joint_damping = fields.Flag("joint_damping", plant.joint_damping);
  plant.self_collision = fields.Flag("self_collision", plant.self_collision);
  fields.Finish();
}

std::vector<Push> ReadPushes(YamlFields* fields) {
  std::vector<Push> pushes;
  for (const YamlFields& push : fields->Maps("pushes")) {
    pushes.push_back(ReadPush(push));
  }
  return pushes;
}

bool IsMultiple(double a, double b) {
  const double ratio = a / b;
  return std::abs(ratio - std::round(ratio)) < 1e-6;
}

void RequireFew(const std::string& list, std::size_t size) {
  if (size <= kMostEntries) return;
  throw InputError::OfValue(list, " has " + std::to_string(size) +
                                      " entries, must have at most " +
                                      std::to_string(kMostEntries));
}

// Checks that no entry contradicts the entries before it.
void CheckOrder(const std::vector<StanceEvent>& stance) {
  double before = 0;
  std::string in_the_air;
  for (std::size_t i = 0; i < stance.size(); ++i) {
    const StanceEvent& event = stance[i];
    const std::string which = EntryPath("stance", i) + ".";
    if (event.at < before) {
      throw InputError::OfValue(
          which + "at", " is " + PrintNumber(event.at) + ", must be at least " +
                            PrintNumber(before) +
                            ", the time of the entry before: entries must be "
                            "in order of time");
    }
    before = event.at;
    if (event.kind == StanceEvent::Kind::kLift) {
      if (!in_the_air.empty()) {
        throw InputError::OfValue(
            which + "lift", " is " + Quoted(event.foot) + ", must come after " +
                                Quoted(in_the_air) +
                                " is put down: one foot is lifted at a time");
      }
      in_the_air = event.foot;
    } else if (event.kind == StanceEvent::Kind::kPutDown) {
      if (in_the_air != event.foot) {
        throw InputError::OfValue(
            which + "put_down",
            " is " + Quoted(event.foot) + ", must be a foot that is lifted");
      }
      in_the_air.clear();
    }
  }
}

// Checks that control period, plant step, delay and duration are compatible.
void CheckTimes(const Scenario& scenario) {
  const double step = scenario.plant.dt, tick = scenario.control.dt;
  const std::string rate = " is " + PrintNumber(1 / tick) + ", must ";
  const std::string plant_rate = ", which is " + PrintNumber(1 / step);
  if (!(tick > step / 2 && IsMultiple(tick, step))) {
    throw InputError::OfValue("control.rate", rate + "evenly divide ",
                              "plant.rate", plant_rate);
  }
  if (!(tick < (kMostStepsInATick + 0.5) * step)) {
    throw InputError::OfValue("control.rate",
                              rate + "be at least a thousandth of ",
                              "plant.rate", plant_rate);
  }
  const double delay = scenario.control.delay;
  if (!IsMultiple(delay, step)) {
    throw InputError::OfValue("control.delay",
                              " is " + PrintNumber(delay) +
                                  ", must be a multiple of the plant's step");
  }
  if (!(scenario.duration <= kMostTicks * tick)) {
    throw InputError::OfValue("duration",
                              " is " + PrintNumber(scenario.duration) +
                                  ", must be at most 1e8 control ticks");
  }
}

// Checks a scenario's name, which is written into JSON and is the default name
// of the output folder.
bool IsPlainName(const std::string& name) {
  constexpr std::size_t kMostBytes = 100;
  return !name.empty() && name.size() <= kMostBytes && name != "." &&
         name != ".." && name.find_first_of("/\\") == std::string::npos &&
         OneLine(name) == name;
}

Scenario ReadScenario(YamlFields fields, const std::string& name) {
  Scenario scenario;
  scenario.name = fields.Text("name", name);
  if (!IsPlainName(scenario.name)) {
    fields.Refuse("name",
                  "must be the name of a file, in UTF-8, of at most 100 bytes");
  }
  fields.Read(Fields(&scenario));
  scenario.seed = ReadSeed(&fields, scenario.seed);
  if (auto robot = fields.Map("chosen_for")) {
    ReadNumbers(*robot, &scenario.chosen_for.emplace());
  }
  if (auto start = fields.Map("start")) ReadNumbers(*start, &scenario.start);
  scenario.steps = fields.Flag("steps", scenario.steps);
  scenario.pushes = ReadPushes(&fields);
  for (const YamlFields& event : fields.Maps("stance")) {
    scenario.stance.push_back(ReadStanceEvent(event));
  }
  if (auto com = fields.Map("com")) ReadNumbers(*com, &scenario.com);
  if (auto tasks = fields.Map("tasks")) ReadTasks(*tasks, &scenario.control);
  if (auto control = fields.Map("control")) {
    ReadControl(*control, &scenario.control);
  }
  if (auto plant = fields.Map("plant")) ReadPlant(*plant, &scenario);
  if (auto sensors = fields.Map("sensors")) {
    ReadNumbers(*sensors, &scenario.sensors);
  }
  fields.Finish();
  return scenario;
}

}  // namespace

Scenario ReadScenario(const std::filesystem::path& file) {
  return ReadScenario(ReadYaml(file.string()), file.stem().string());
}

Scenario ParseScenario(const std::string& text, const std::string& source,
                       const std::string& name) {
  return ReadScenario(YamlFields(ParseYaml(text, source), source), name);
}

Scenario LoadScenario(const std::filesystem::path& file) {
  Scenario scenario = ReadScenario(file);
  try {
    Validate(scenario);
  } catch (const InputError& error) {
    const int line = LineOf(file.string(), error.field());
    throw InputError(error.field(),
                     file.string() + ":" +
                         (line > 0 ? std::to_string(line) + ":" : "") + " " +
                         error.what());
  }
  return scenario;
}

std::vector<Push> LoadPushes(const std::filesystem::path& file) {
  YamlFields fields = ReadYaml(file.string());
  std::vector<Push> pushes = ReadPushes(&fields);
  fields.Finish();
  return pushes;
}

void Validate(const Scenario& scenario) {
  Validate(scenario.plant);
  Scenario copy = scenario;
  Check("", Fields(&copy));
  if (copy.chosen_for) Check("chosen_for", Fields(&*copy.chosen_for));
  Check("start", Fields(&copy.start));
  Check("com", Fields(&copy.com));
  Check("control", Fields(&copy.control));
  Check("sensors", Fields(&copy.sensors));
  RequireFew("pushes", copy.pushes.size());
  RequireFew("stance", copy.stance.size());
  for (std::size_t i = 0; i < copy.pushes.size(); ++i) {
    Check(EntryPath("pushes", i), Fields(&copy.pushes[i]));
    CheckFraction(EntryPath("pushes", i), copy.pushes[i]);
  }
  for (std::size_t i = 0; i < copy.stance.size(); ++i) {
    Check(EntryPath("stance", i), Fields(&copy.stance[i]));
  }
  CheckOrder(copy.stance);
  for (std::size_t i = 0; i < copy.stance.size(); ++i) {
    const bool is_step = copy.stance[i].kind == StanceEvent::Kind::kStep;
    if (!is_step || copy.steps) continue;
    throw InputError::OfValue(
        EntryPath("stance", i) + ".step",
        " is " + Quoted(copy.stance[i].foot) + ", must come with steps: on");
  }
  CheckTimes(copy);
}

}  // namespace poise
