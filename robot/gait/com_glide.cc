// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/com_glide.h"

namespace poise {
namespace {

// A quintic with less time than this would need large accelerations; the
// coordinate brakes instead.
constexpr double kLeastTime = 0.02;  // s.
constexpr double kBrakeTime = 0.01;  // s.

void Glide(double dt, double goal, double time, Quintic* x) noexcept {
  if (time > kLeastTime) {
    x->Advance(dt, goal, time);
  } else {
    x->Brake(dt, kBrakeTime);
  }
}

}  // namespace

void ComGlide::StartAt(const Reference& reference) noexcept {
  for (int i = 0; i < 2; ++i) com_[i] = {reference.p_WG[i], 0, 0};
  com_[2] = {reference.p_WG.z() - reference.ground_z, 0, 0};
}

void ComGlide::RestartPlane(const Eigen::Vector2d& p_WG,
                            const Eigen::Vector2d& v_WG) noexcept {
  for (int i = 0; i < 2; ++i) com_[i] = {p_WG[i], v_WG[i], 0};
}

void ComGlide::MoveTo(double dt, const Eigen::Vector2d& p_WG, double height,
                      double time, Reference* reference) noexcept {
  for (int i = 0; i < 2; ++i) {
    Glide(dt, p_WG[i], time, &com_[i]);
    reference->p_WG[i] = com_[i].p;
    reference->v_WG[i] = com_[i].v;
    reference->a_WG[i] = com_[i].a;
  }
  MoveHeightTo(dt, height, time, reference);
}

void ComGlide::MoveHeightTo(double dt, double height, double time,
                            Reference* reference) noexcept {
  Glide(dt, height, time, &com_[2]);
  reference->p_WG.z() = reference->ground_z + com_[2].p;
  reference->v_WG.z() = com_[2].v;
  reference->a_WG.z() = com_[2].a;
}

}  // namespace poise
