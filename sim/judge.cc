// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "sim/judge.h"

#include <algorithm>
#include <cmath>

namespace poise {

void Judge::Look(const Observation& now) {
  // Written so that a state that is no number counts as fallen.
  down_ = down_ || !(now.base_height >= kLowestBase * standing_height_ &&
                     now.base_tilt <= kLargestTilt);
  bool feet_lost = false;
  for (const FootObservation& foot : now.feet) {
    verdict_.foot_tilt_peak = std::max(verdict_.foot_tilt_peak, foot.tilt);
    verdict_.foot_slide_peak = std::max(verdict_.foot_slide_peak, foot.slide);
    feet_lost =
        feet_lost || foot.tilt > kLargestFootTilt || foot.slide > kLargestSlide;
  }
  if ((down_ || feet_lost) && !verdict_.fell_at) verdict_.fell_at = now.time;

  const Eigen::Vector3d error = now.com - now.com_ref;
  verdict_.com_error_peak = verdict_.com_error_peak.cwiseMax(error.cwiseAbs());
  for (int i = 0; i < 2; ++i) {
    if (std::isnan(now.cop[i])) continue;
    verdict_.cop_peak[i] = std::max(verdict_.cop_peak[i], std::abs(now.cop[i]));
  }
  last_errors_.push_back({now.time, error});
  while (last_errors_.front().time < now.time - kEnd) last_errors_.pop_front();
}

Verdict Judge::Conclude() const {
  Verdict verdict = verdict_;
  for (const ComError& each : last_errors_) {
    verdict.com_error_final +=
        each.error / static_cast<double>(last_errors_.size());
  }
  verdict.recovered =
      !verdict.fell_at && !last_errors_.empty() &&
      verdict.com_error_final.head<2>().norm() < kLargestComError;
  return verdict;
}

}  // namespace poise
