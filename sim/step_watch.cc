// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/step_watch.h"

#include <algorithm>

namespace poise {
namespace {

constexpr double kImpactTime = 0.010;  // s, see TakenStep::impact_Ns.

}  // namespace

void StepWatch::Look(const TickRecord& record) {
  feet_.resize(record.observation.feet.size());
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    LookAtFoot(record, static_cast<int>(i));
  }
}

void StepWatch::LookAtFoot(const TickRecord& record, int foot) {
  const FootObservation& now = record.observation.feet[foot];
  const double time = record.observation.time;
  FootState& state = feet_[foot];
  const Eigen::Vector2d p_WC = now.X_WC.p.head<2>();
  const bool steps = record.stance.phase(foot) == ContactPhase::kStepping;
  if (steps && !state.steps) {
    TakenStep step;
    step.foot = foot;
    step.at = time;
    step.is_commanded = record.gait != nullptr && record.gait->is_commanded();
    state.step = static_cast<int>(steps_.size());
    steps_.push_back(step);
    state.touched_at = -1;
  }
  if (state.step >= 0) {
    TakenStep& step = steps_[state.step];
    // The foot may touch the ground before its landing, so the last touch
    // counts.
    const bool touches = now.in_contact && !state.was_in_contact;
    if (touches && (steps || state.touched_at < 0)) {
      state.touched_at = time;
      step.touchdown_speed = (p_WC - state.p_WC).norm() / (time - state.time);
      step.impact_Ns = 0;
    }
    const double dt = time - state.time;
    if (state.touched_at >= 0 && time < state.touched_at + kImpactTime) {
      const double commanded = record.report.foot_wrench(record.nv, foot)[5];
      step.impact_Ns += dt * std::max(0.0, now.F_Co_C[5] - commanded);
    }
    if (steps && record.gait != nullptr) {
      step.planned = record.gait->goal_W();
    }
    if (!steps && state.steps) {
      step.has_landed = true;
      step.landed = p_WC;
      step.swing_time = time - step.at;
    }
    if (step.has_landed && now.down) {
      step.slide = std::max(step.slide, now.slide);
    }
  }
  state.steps = steps;
  state.was_in_contact = now.in_contact;
  state.time = time;
  state.p_WC = p_WC;
}

}  // namespace poise
