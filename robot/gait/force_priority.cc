// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/force_priority.h"

#include <algorithm>
#include <string_view>

namespace poise {

void ForcePriority::Set(bool is_on, Stack* stack) noexcept {
  if (is_on == is_on_) return;
  is_on_ = is_on;
  constexpr std::array<std::string_view, kTasks> kNames = {"cop", "friction",
                                                           "unilateral", "yaw"};
  for (int i = 0; i < kTasks; ++i) {
    // A stack without this task has no such limit.
    const auto task = stack->Find(kNames[i]);
    if (!task) continue;
    if (is_on) before_[i] = stack->settings(*task).weight;
    const double weight =
        is_on ? std::min(kFactor * before_[i], Stack::kMostWeight) : before_[i];
    [[maybe_unused]] const bool is_set = stack->SetWeight(kNames[i], weight);
  }
}

}  // namespace poise
