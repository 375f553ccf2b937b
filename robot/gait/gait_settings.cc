// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/gait_settings.h"

#include <cmath>

namespace poise {
namespace {

SwingPath::Settings Scaled(SwingPath::Settings path, double length,
                           double time) {
  path.clearance *= length;
  path.search_speed *= length / time;
  path.search_depth *= length;
  return path;
}

}  // namespace

GaitSettings Scaled(const GaitSettings& settings, double com_height) {
  const double length = com_height / GaitSettings::kTunedHeight;
  const double time = std::sqrt(length);
  GaitSettings scaled = settings;
  scaled.region.max_sink *= length;
  scaled.path = Scaled(settings.path, length, time);
  scaled.time_min *= time;
  scaled.time_max *= time;
  scaled.swing_speed *= length / time;
  scaled.freeze *= time;
  scaled.sole_gap *= length;
  scaled.min_sink *= length;
  scaled.square *= length;
  // It weighs a number against squares of lengths.
  scaled.time_weight *= length * length;
  // It weighs squares of moments against squares of forces.
  scaled.angular_weight /= length * length;
  scaled.command_path = Scaled(settings.command_path, length, time);
  scaled.shift_time *= time;
  scaled.command_time *= time;
  scaled.rest_time *= time;
  return scaled;
}

}  // namespace poise
