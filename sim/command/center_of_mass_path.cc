// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/center_of_mass_path.h"

#include <cmath>

namespace poise {

namespace {

constexpr double kPi = 3.14159265358979323846;

}  // namespace

void CenterOfMassPath::Write(double time, Reference* reference) const {
  const EasedVector::Motion center = center_.At(time);
  const double w = 2 * kPi / motion_.period;
  const double sine = std::sin(w * time), cosine = std::cos(w * time);
  const Eigen::Vector3d swing = sine * motion_.sine + cosine * motion_.cosine;
  reference->p_WG = center.value + swing;
  reference->v_WG =
      center.rate + w * (cosine * motion_.sine - sine * motion_.cosine);
  reference->a_WG = center.acceleration - w * w * swing;
}

}  // namespace poise
