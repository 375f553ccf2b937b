// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/scenario_fields.h"

#include "poise/robot/control/stance.h"

namespace poise {
namespace {

constexpr double kLongest = 86400;  // Largest time and duration, s.

}  // namespace

std::vector<NumberField> Fields(StartSettings* start) {
  return {{"joints", &start->joints, 0, 3.2, "rad"},
          {"drop", &start->drop, 0, 10, "m"},
          {"heading", &start->heading, -10, 10, "rad"},
          {"place", start->place.data(), -1e5, 1e5, "m", 2}};
}

std::vector<NumberField> Fields(ChosenFor* robot) {
  return {{"mass", &robot->mass, 1e-6, 1e9, "kg"},
          {"com_height", &robot->com_height, 1e-6, 1e6, "m"}};
}

std::vector<NumberField> Fields(Push* push) {
  std::vector<NumberField> fields = {
      {"force", push->force.data(), -1e6, 1e6, "N", 3},
      {"moment", push->moment.data(), -1e6, 1e6, "N m", 3},
      {"at", &push->start, 0, kLongest, "s"},
      {"duration", &push->duration, 0, kLongest, "s"}};
  if (push->point) {
    fields.push_back({"point", push->point->data(), -100, 100, "m", 3});
  }
  if (push->impulse_fraction) {
    fields.push_back({"impulse_fraction", &*push->impulse_fraction, 0, 1000});
  }
  if (push->elsewhere) {
    fields.push_back({"elsewhere", &*push->elsewhere, 0, 1000});
  }
  return fields;
}

std::vector<NumberField> Fields(ComMotion* com) {
  return {{"sine", com->sine.data(), -10, 10, "m", 3},
          {"cosine", com->cosine.data(), -10, 10, "m", 3},
          {"period", &com->period, 0.01, kLongest, "s"}};
}

std::vector<NumberField> Fields(StanceEvent* event) {
  return {{"at", &event->at, 0, kLongest, "s"},
          {"height", &event->height, Stance::kLeastHeight, Stance::kMostHeight,
           "m"},
          {"over", &event->over, 0.01, kLongest, "s"}};
}

std::vector<NumberField> Fields(ControlSettings* control) {
  return {{"rate", &control->dt, 10, 1e5, "Hz", 1, true},
          {"delay", &control->delay, 0, 1, "s"},
          {"friction", &control->friction, 0, 10},
          {"mass_error", &control->mass_error, -0.99, 10},
          {"ramp", &control->ramp, 0, 100, "s"},
          {"budget_us", &control->budget_us, 0, 1e6, "us"}};
}

std::vector<NumberField> Fields(SensorSettings* s) {
  return {{"noise", &s->noise, 0, 1000},
          {"bias", &s->bias, 0, 1000},
          {"resolution", &s->resolution, 0, 1000},
          {"joint_position", &s->joint_position, 0, 10, "rad"},
          {"joint_velocity", &s->joint_velocity, 0, 1000, "rad/s"},
          {"base_position", &s->base_position, 0, 10, "m"},
          {"base_orientation", &s->base_orientation, 0, 10, "rad"},
          {"base_rate", &s->base_rate, 0, 1000, "rad/s"},
          {"base_velocity", &s->base_velocity, 0, 1000, "m/s"},
          {"foot_force", &s->foot_force, 0, 1e6, "N"},
          {"foot_moment", &s->foot_moment, 0, 1e6, "N m"},
          {"accelerometer", &s->accelerometer, 0, 1e6, "m/s2"},
          {"gyroscope", &s->gyroscope, 0, 1000, "rad/s"},
          {"joint_bias", &s->joint_bias, 0, 10, "rad"},
          {"gyroscope_bias", &s->gyroscope_bias, 0, 1000, "rad/s"},
          {"force_bias", &s->force_bias, 0, 1e6, "N"},
          {"joint_resolution", &s->joint_resolution, 0, 10, "rad"},
          {"force_resolution", &s->force_resolution, 0, 1e6, "N"},
          {"joint_delay", &s->joint_delay, 0, 1, "s"},
          {"base_delay", &s->base_delay, 0, 1, "s"},
          {"foot_delay", &s->foot_delay, 0, 1, "s"},
          {"dropout", &s->dropout, 0, 1},
          {"freeze_at", &s->freeze_at, 0, kLongest, "s"},
          {"freeze_for", &s->freeze_for, 0, kLongest, "s"},
          {"contact_threshold", &s->contact_threshold, 0, 1e6, "N"}};
}

std::vector<NumberField> Fields(Scenario* scenario) {
  return {{"duration", &scenario->duration, 1e-3, kLongest, "s"}};
}

}  // namespace poise
