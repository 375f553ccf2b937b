// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/judge.h"

#include <algorithm>
#include <cmath>

namespace poise {

void Judge::Look(const Observation& now) {
  // The comparison is negated so that a NaN counts as a fall.
  const bool is_low = !(now.com_height >= kLowestCom * standing_height_);
  const bool is_tilted = !(now.base_tilt <= kLargestTilt);
  down_ = down_ || is_low || is_tilted;
  if (is_low) Fall(now.time, "the CoM sank below 60 % of its height");
  if (is_tilted) Fall(now.time, "the base tilted over 60 degrees");
  for (const FootObservation& foot : now.feet) {
    verdict_.foot_tilt_peak = std::max(verdict_.foot_tilt_peak, foot.tilt);
    verdict_.foot_slide_peak = std::max(verdict_.foot_slide_peak, foot.slide);
    if (foot.tilt > kLargestFootTilt) {
      Fall(now.time, "a foot tilted over 0.1 rad");
    }
    if (foot.slide > kLargestSlide) {
      Fall(now.time, "a foot slid over 30 mm");
    }
  }

  const Eigen::Vector3d error = now.com - now.com_ref;
  verdict_.com_error_peak = verdict_.com_error_peak.cwiseMax(error.cwiseAbs());
  for (int i = 0; i < 2; ++i) {
    if (std::isnan(now.cop[i])) continue;
    verdict_.cop_peak[i] = std::max(verdict_.cop_peak[i], std::abs(now.cop[i]));
  }
  const bool all_down =
      std::all_of(now.feet.begin(), now.feet.end(),
                  [](const FootObservation& foot) { return foot.down; });
  last_ticks_.push_back(
      {now.time, error, all_down && now.com_velocity.norm() < kAtRest});
  while (last_ticks_.front().time < now.time - kEnd) last_ticks_.pop_front();
}

void Judge::Fall(double time, const char* how) {
  if (verdict_.fell_at) return;
  verdict_.fell_at = time;
  verdict_.fell_by = how;
}

Verdict Judge::Conclude() const {
  Verdict verdict = verdict_;
  for (const LastTick& each : last_ticks_) {
    verdict.com_error_final +=
        each.error / static_cast<double>(last_ticks_.size());
  }
  const bool at_rest =
      std::all_of(last_ticks_.begin(), last_ticks_.end(),
                  [](const LastTick& tick) { return tick.at_rest; });
  verdict.recovered =
      !verdict.fell_at && !last_ticks_.empty() &&
      verdict.com_error_final.head<2>().norm() < kLargestComError &&
      (at_rest || !steps_);
  return verdict;
}

}  // namespace poise
