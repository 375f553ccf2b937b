// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "sim/scenario.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/yaml_fields.h"

namespace poise {

namespace {

StartSettings ReadStart(YamlFields fields) {
  StartSettings start;
  start.joints = fields.Number("joints", start.joints);
  start.drop = fields.Number("drop", start.drop);
  start.heading = fields.Number("heading", start.heading);
  fields.Finish();
  return start;
}

Push ReadPush(YamlFields fields) {
  Push push;
  push.link = fields.Text("link", push.link);
  const Eigen::Vector3d point = fields.Vector("point", {0, 0, 0});
  if (fields.Has("point")) push.point = point;
  const std::string frame = fields.Text("frame", "world");
  if (frame == "link") {
    push.frame = PushFrame::kLink;
  } else if (frame != "world") {
    fields.Refuse("frame", "must be world or link");
  }
  push.force = fields.Vector("force", push.force);
  push.moment = fields.Vector("moment", push.moment);
  const std::string profile = fields.Text("profile", "box");
  if (profile == "half_sine") {
    push.profile = PushProfile::kHalfSine;
  } else if (profile == "impulse") {
    push.profile = PushProfile::kImpulse;
  } else if (profile != "box") {
    fields.Refuse("profile", "must be box, half_sine or impulse");
  }
  push.start = fields.Number("at", push.start);
  push.duration = fields.Number("duration", push.duration);
  if (push.duration < 0) fields.Refuse("duration", "must be at least 0");
  fields.Finish();
  return push;
}

ComMotion ReadCom(YamlFields fields) {
  ComMotion com;
  com.sine = fields.Vector("sine", com.sine);
  com.cosine = fields.Vector("cosine", com.cosine);
  com.period = fields.Number("period", com.period);
  if (com.period <= 0) fields.Refuse("period", "must be positive");
  fields.Finish();
  return com;
}

StanceEvent ReadStanceEvent(YamlFields fields) {
  StanceEvent event;
  event.at = fields.Number("at", event.at);
  const std::string lift = fields.Text("lift", "");
  const std::string put_down = fields.Text("put_down", "");
  const std::string shift = fields.Text("shift", "");
  event.height = fields.Number("height", event.height);
  event.over = fields.Number("over", event.over);
  fields.Finish();
  if (event.over <= 0) fields.Refuse("over", "must be positive");
  if (event.height <= 0) fields.Refuse("height", "must be positive");
  if (!lift.empty()) {
    event.kind = StanceEvent::Kind::kLift;
    event.foot = lift;
  } else if (!put_down.empty()) {
    event.kind = StanceEvent::Kind::kPutDown;
    event.foot = put_down;
  } else if (!shift.empty()) {
    event.foot = shift == "middle" ? "" : shift;
  } else {
    fields.Refuse("at", "must go with lift, put_down or shift");
  }
  return event;
}

void ReadTasks(YamlFields fields, ControlSettings* control) {
  control->tasks = fields.Text("set", control->tasks);
  control->with = fields.Words("with");
  control->without = fields.Words("without");
  fields.Finish();
}

// 1 / rate, where there is one.
double ReadStep(YamlFields* fields, double otherwise) {
  const double rate = fields->Number("rate", 1 / otherwise);
  if (rate <= 0) fields->Refuse("rate", "must be positive");
  return 1 / rate;
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
  control->dt = ReadStep(&fields, control->dt);
  control->delay = fields.Number("delay", control->delay);
  control->friction = fields.Number("friction", control->friction);
  control->mass_error = fields.Number("mass_error", control->mass_error);
  control->inscribed = fields.Flag("inscribed", control->inscribed);
  control->feedforward = fields.Flag("feedforward", control->feedforward);
  control->weighted = fields.Flag("weighted", control->weighted);
  control->estimator = fields.Flag("estimator", control->estimator);
  fields.Finish();
}

void ReadPlant(YamlFields fields, Scenario* scenario) {
  PlantSettings& plant = scenario->plant;
  const std::string kind = fields.Text("kind", "bullet");
  if (kind == "mujoco") {
    scenario->plant_kind = PlantKind::kMujoco;
  } else if (kind != "bullet") {
    fields.Refuse("kind", "must be bullet or mujoco");
  }
  plant.dt = ReadStep(&fields, plant.dt);
  plant.friction = fields.Number("friction", plant.friction);
  plant.torque_scale = fields.Number("torque_scale", plant.torque_scale);
  plant.ground.roll = fields.Number("roll", plant.ground.roll);
  plant.ground.pitch = fields.Number("pitch", plant.ground.pitch);
  for (YamlFields& board : fields.Maps("boards")) {
    plant.ground.boards.push_back({board.Vector("center", {0, 0, 0}),
                                   board.Vector("size", {0, 0, 0}),
                                   board.Number("yaw", 0)});
    board.Finish();
  }
  plant.joint_limits = fields.Flag("joint_limits", plant.joint_limits);
  plant.joint_damping = fields.Flag("joint_damping", plant.joint_damping);
  plant.self_collision = fields.Flag("self_collision", plant.self_collision);
  fields.Finish();
}

SensorSettings ReadSensors(YamlFields fields) {
  SensorSettings sensors;
  const struct {
    const char* key;
    double* value;
  } numbers[] = {{"noise", &sensors.noise},
                 {"joint_position", &sensors.joint_position},
                 {"joint_velocity", &sensors.joint_velocity},
                 {"base_orientation", &sensors.base_orientation},
                 {"base_rate", &sensors.base_rate},
                 {"foot_force", &sensors.foot_force},
                 {"foot_moment", &sensors.foot_moment},
                 {"accelerometer", &sensors.accelerometer},
                 {"gyroscope", &sensors.gyroscope},
                 {"joint_bias", &sensors.joint_bias},
                 {"gyroscope_bias", &sensors.gyroscope_bias},
                 {"force_bias", &sensors.force_bias},
                 {"joint_resolution", &sensors.joint_resolution},
                 {"force_resolution", &sensors.force_resolution},
                 {"dropout", &sensors.dropout},
                 {"contact_threshold", &sensors.contact_threshold}};
  for (const auto& [key, value] : numbers) {
    *value = fields.Number(key, *value);
    if (*value < 0) fields.Refuse(key, "must be at least 0");
  }
  fields.Finish();
  return sensors;
}

std::vector<Push> ReadPushes(YamlFields* fields) {
  std::vector<Push> pushes;
  for (const YamlFields& push : fields->Maps("pushes")) {
    pushes.push_back(ReadPush(push));
  }
  return pushes;
}

void Require(bool holds, const std::string& name, double value,
             const std::string& wanted) {
  if (holds) return;
  throw std::invalid_argument("scenario: " + name + " is " +
                              std::to_string(value) + ", must be " + wanted);
}

bool IsMultiple(double a, double b) {
  const double ratio = a / b;
  return std::abs(ratio - std::round(ratio)) < 1e-6;
}

}  // namespace

Scenario LoadScenario(const std::filesystem::path& file) {
  YamlFields fields = ReadYaml(file.string());
  Scenario scenario;
  scenario.name = fields.Text("name", file.stem().string());
  scenario.duration = fields.Number("duration", scenario.duration);
  scenario.seed = ReadSeed(&fields, scenario.seed);
  if (auto start = fields.Map("start")) scenario.start = ReadStart(*start);
  scenario.pushes = ReadPushes(&fields);
  for (const YamlFields& event : fields.Maps("stance")) {
    scenario.stance.push_back(ReadStanceEvent(event));
  }
  if (auto com = fields.Map("com")) scenario.com = ReadCom(*com);
  if (auto tasks = fields.Map("tasks")) ReadTasks(*tasks, &scenario.control);
  if (auto control = fields.Map("control")) {
    ReadControl(*control, &scenario.control);
  }
  if (auto plant = fields.Map("plant")) ReadPlant(*plant, &scenario);
  if (auto sensors = fields.Map("sensors")) {
    scenario.sensors = ReadSensors(*sensors);
  }
  fields.Finish();
  Validate(scenario);
  return scenario;
}

std::vector<Push> LoadPushes(const std::filesystem::path& file) {
  YamlFields fields = ReadYaml(file.string());
  std::vector<Push> pushes = ReadPushes(&fields);
  fields.Finish();
  return pushes;
}

void Validate(const Scenario& scenario) {
  // A comparison with NaN is false, so each of these refuses it.
  Validate(scenario.plant);
  const ControlSettings& control = scenario.control;
  Require(scenario.duration > 0 && scenario.duration <= 1e5, "duration",
          scenario.duration, "in (0, 1e5] s");
  Require(control.dt > 0 && control.dt <= 0.1, "control step", control.dt,
          "in (0, 0.1] s");
  Require(IsMultiple(control.dt, scenario.plant.dt) &&
              control.dt > scenario.plant.dt / 2,
          "control step", control.dt, "a multiple of the plant's");
  Require(control.delay >= 0 && control.delay <= 1, "delay", control.delay,
          "in [0, 1] s");
  Require(IsMultiple(control.delay, scenario.plant.dt), "delay", control.delay,
          "a multiple of the plant's step");
  Require(control.mass_error > -1 && control.mass_error < 10, "mass error",
          control.mass_error, "in (-1, 10)");
  Require(scenario.sensors.noise >= 0 && std::isfinite(scenario.sensors.noise),
          "noise", scenario.sensors.noise, "at least 0");
  Require(std::isfinite(scenario.start.drop) && scenario.start.drop >= 0,
          "drop", scenario.start.drop, "at least 0 m");
}

}  // namespace poise
