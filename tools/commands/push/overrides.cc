// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push/overrides.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "poise/robot/finding.h"
#include "poise/sim/number_field.h"
#include "poise/sim/plants/make_plant.h"
#include "poise/tools/commands/user_path.h"

namespace poise {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Rejects NaN and infinity, which CLI11 accepts as numbers.
std::string RefuseInfinite(std::string& text) {
  const double value = std::strtod(text.c_str(), nullptr);
  return std::isfinite(value) ? "" : "is " + text + ", must be finite";
}

// Rejects an invalid seed with its range. The message of CLI11 about a number
// that is too large says that it is not a number.
std::string RefuseNoSeed(std::string& text) {
  unsigned seed = 0;
  const char* text_end = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), text_end, seed);
  if (error == std::errc() && end == text_end) return "";
  return "is " + Quoted(text) + ", must be a whole number from 0 to " +
         std::to_string(std::numeric_limits<unsigned>::max());
}

template <typename T>
void Take(const std::optional<T>& from, T* to) {
  if (from) *to = *from;
}

void TakeRate(const std::optional<double>& rate, double* dt) {
  if (rate) *dt = 1 / *rate;
}

// Writes the options about a push into the first push of the scenario, or into
// a new push.
void TakePush(const Overrides& o, Scenario* scenario) {
  if (o.pushes) scenario->pushes = LoadPushes(UserPath(*o.pushes));
  if (!o.force && !o.impulse_fraction && !o.direction && !o.duration && !o.at &&
      !o.link && o.point.empty()) {
    return;
  }
  if (scenario->pushes.empty()) {
    scenario->pushes.emplace_back();
    scenario->pushes[0].force = {0, 50, 0};
  }
  Push& push = scenario->pushes[0];
  if (o.force) SetForce(push.force, &push);
  const double force = o.force.value_or(push.force.norm());
  if (o.direction) {
    double degrees = *o.direction;
    Check("", {{"direction", &degrees, -360, 360, "deg"}});
    const double angle = degrees * kPi / 180;
    push.force = force * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
  } else if (o.force) {
    push.force = push.force.isZero() ? Eigen::Vector3d(0, force, 0)
                                     : force * push.force.normalized();
  }
  if (o.impulse_fraction) {
    push.impulse_fraction = o.impulse_fraction;
    push.elsewhere.reset();
  }
  Take(o.duration, &push.duration);
  Take(o.at, &push.start);
  Take(o.link, &push.link);
  if (!o.point.empty()) {
    push.point = Eigen::Vector3d(o.point[0], o.point[1], o.point[2]);
  }
}

// Adds the options about the push.
void AddPushOptions(CLI::App* app, Overrides* o) {
  const CLI::Validator finite(RefuseInfinite, "", "finite");
  app->add_option("--force", o->force,
                  "force of the push, N (from the scenario)")
      ->check(finite);
  app->add_option("--impulse-fraction", o->impulse_fraction,
                  "impulse of the push, as a fraction of lipm_height_Ns in "
                  "summary.json; in place of --force")
      ->check(finite)
      ->excludes("--force");
  app->add_option(
         "--direction", o->direction,
         "direction of the push, deg: 0 is +x, forward; 90 is +y, left "
         "(from the scenario)")
      ->check(finite);
  app->add_option("--duration", o->duration,
                  "duration of the push, s (from the scenario)")
      ->check(finite);
  app->add_option("--at", o->at,
                  "time at which the push begins, s (from the scenario)")
      ->check(finite);
  app->add_option("--link", o->link,
                  "pushed link; the force acts at its center of mass (torso)");
  app->add_option("--point", o->point,
                  "point of the force in the link's frame, X,Y,Z in m")
      ->delimiter(',')
      ->expected(3)
      ->check(finite);
  app->add_option("--pushes", o->pushes,
                  "YAML file of pushes, which replace those of the scenario");
}

// Adds the options about the run, the tasks and the controller.
void AddControlOptions(CLI::App* app, Overrides* o) {
  const CLI::Validator finite(RefuseInfinite, "", "finite");
  app->add_option("--time", o->time, "time to simulate, s")->check(finite);
  app->add_option("--tasks", o->tasks, "task set: a name or a YAML file");
  app->add_option("--with", o->with, "tasks to switch on")->delimiter(',');
  app->add_option("--without", o->without, "tasks to switch off")
      ->delimiter(',');
  app->add_flag("--weighted", o->weighted,
                "one weighted QP instead of the hierarchy");
  app->add_option("--friction-pyramid,--friction", o->friction,
                  "shape of the controller's friction pyramid (circumscribed); "
                  "inscribed divides its mu by sqrt(2)")
      ->check(CLI::IsMember({"circumscribed", "inscribed"}));
  app->add_option("--steps", o->steps,
                  "whether the robot takes steps if it has to (off)")
      ->check(CLI::IsMember({"on", "off"}));
  app->add_flag("--feedforward", o->feedforward,
                "use velocity and acceleration of the reference");
  app->add_option("--control-rate", o->control_rate,
                  "rate of the controller, Hz (1000)")
      ->check(finite);
  app->add_option("--budget-us", o->budget_us,
                  "limit of the solver's time in a tick, us, 0 to 1e6, "
                  "predicted from its work, so that a replay is exact; the "
                  "solver makes at least two iterations (0: no limit)")
      ->check(finite);
  app->add_flag_function(
      "--budget-clock",
      [o](std::int64_t is_on) { o->budget_clock = is_on > 0; },
      "count the budget by the clock, not by predicted time; a replay then "
      "differs");
}

// Adds the options about the simulator and the sensors.
void AddPlantOptions(CLI::App* app, Overrides* o) {
  const CLI::Validator finite(RefuseInfinite, "", "finite");
  app->add_option("--plant", o->plant, "simulator (" + PlantNames()[0] + ")")
      ->check(CLI::IsMember(PlantNames()));
  app->add_option("--plant-rate", o->plant_rate,
                  "rate of the simulator, Hz (1000)")
      ->check(finite);
  app->add_flag(
      "--estimator", o->estimator,
      "estimate the base from sensors, instead of from the simulator");
  app->add_option("--mu-plant", o->mu_plant,
                  "friction coefficient of the ground (0.8)")
      ->check(finite);
  app->add_option("--mass-error", o->mass_error,
                  "relative error of all masses in the controller's model")
      ->check(finite);
  app->add_option("--torque-scale", o->torque_scale,
                  "factor on the torque limits of controller and motors")
      ->check(finite);
  app->add_option(
         "--noise", o->noise,
         "scale of the sensor noise; 1 is 2 mrad and 0.1 rad/s on each "
         "joint, 4 mrad and 0.02 rad/s on the base")
      ->check(finite);
  app->add_option("--delay", o->delay, "delay from measurement to torque, s")
      ->check(finite);
  app->add_option(
         "--ramp", o->ramp,
         "time over which a change of tasks takes effect, s (0: at once)")
      ->check(finite);
  app->add_option("--freeze", o->freeze,
                  "AT,FOR in s: from AT on, sensors repeat their last reading")
      ->delimiter(',')
      ->expected(2)
      ->check(finite);
  app->add_option("--seed", o->seed,
                  "seed of all random numbers (from the scenario)")
      ->check(CLI::Validator(RefuseNoSeed, "", "seed"));
}

}  // namespace

void AddOptions(CLI::App* app, Overrides* o) {
  // This is the order of --help.
  AddPushOptions(app, o);
  AddControlOptions(app, o);
  AddPlantOptions(app, o);
}

void RefuseBoth(const std::vector<std::string>& with,
                const std::vector<std::string>& without) {
  for (const std::string& task : with) {
    if (std::find(without.begin(), without.end(), task) == without.end()) {
      continue;
    }
    throw std::invalid_argument(
        "task " + Quoted(task) +
        " is in --with and in --without, must be in one of them");
  }
}

void Apply(const Overrides& o, Scenario* scenario) {
  RefuseBoth(o.with, o.without);
  TakePush(o, scenario);
  ControlSettings& control = scenario->control;
  PlantSettings& plant = scenario->plant;
  Take(o.time, &scenario->duration);
  Take(o.seed, &scenario->seed);
  if (o.tasks) {
    std::error_code too_long;
    const bool is_file = std::filesystem::exists(UserPath(*o.tasks), too_long);
    control.tasks = is_file ? UserPath(*o.tasks).string() : *o.tasks;
  }
  control.with.insert(control.with.end(), o.with.begin(), o.with.end());
  control.without.insert(control.without.end(), o.without.begin(),
                         o.without.end());
  control.weighted |= o.weighted;
  control.feedforward |= o.feedforward;
  control.estimator |= o.estimator;
  Take(o.budget_us, &control.budget_us);
  if (o.budget_us == 0.0) control.budget_clock = false;
  Take(o.budget_clock, &control.budget_clock);
  if (o.steps) scenario->steps = *o.steps == "on";
  if (o.friction) control.inscribed = *o.friction == "inscribed";
  TakeRate(o.control_rate, &control.dt);
  TakeRate(o.plant_rate, &plant.dt);
  if (o.plant) scenario->plant_kind = *o.plant;
  Take(o.mu_plant, &plant.friction);
  Take(o.mass_error, &control.mass_error);
  Take(o.torque_scale, &plant.torque_scale);
  Take(o.noise, &scenario->sensors.noise);
  Take(o.delay, &control.delay);
  Take(o.ramp, &control.ramp);
  if (!o.freeze.empty()) {
    if (o.freeze[1] == 0) {
      throw std::invalid_argument("--freeze is " + PrintNumber(o.freeze[0]) +
                                  ",0, must be AT,FOR with FOR above 0 s");
    }
    scenario->sensors.freeze_at = o.freeze[0];
    scenario->sensors.freeze_for = o.freeze[1];
  }
}

}  // namespace poise
