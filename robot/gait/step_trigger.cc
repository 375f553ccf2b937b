// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/step_trigger.h"

#include <algorithm>
#include <cmath>

namespace poise {
namespace {

// Lower bound on the distance to an edge, so that a robot on a line divides by
// no zero.
constexpr double kLeastEdge = 0.02;  // m.

// Strengths, see TurnStrength, up to which a robot can hardly rely on turning
// its trunk, and from which on it can.
struct Range {
  double weak, strong;
};
constexpr Range kSagittal{3.2, 3.7};
constexpr Range kLateral{3, 7};

double Share(const Range& range, double strength) {
  return std::clamp((strength - range.weak) / (range.strong - range.weak), 0.0,
                    1.0);
}

// Exactly `strong` for the share 1.
double Between(double weak, double strong, double share) {
  return strong - (1 - share) * (strong - weak);
}

struct Excursion {
  double fraction, beyond;  // beyond: m.
};

Excursion Predict(double xi, double a, double omega, double T, double plus,
                  double minus) {
  plus = std::max(kLeastEdge, plus);
  minus = std::max(kLeastEdge, minus);
  const double growth = std::exp(omega * T);
  const double pushed = a / (omega * omega) * (growth - 1);
  // The CoP p changes xi(T) by -p (growth - 1): the best one brings xi(T) to
  // zero, or is at an edge.
  const double without = xi * growth + pushed;
  const double most = growth - 1;
  const double xi_T = without - std::clamp(without, -minus * most, plus * most);
  return xi_T > 0 ? Excursion{xi_T / plus, xi_T - plus}
                  : Excursion{-xi_T / minus, -xi_T - minus};
}

}  // namespace

EdgeFractions PredictEdgeFractions(const Eigen::Vector2d& xi_Mid,
                                   const Eigen::Vector2d& a_Mid, double omega,
                                   double T, const SupportBox& box) noexcept {
  const Excursion x =
      Predict(xi_Mid.x(), a_Mid.x(), omega, T, box.front, box.back);
  const Excursion y =
      Predict(xi_Mid.y(), a_Mid.y(), omega, T, box.left, box.right);
  return {x.fraction, y.fraction, std::max({0.0, x.beyond, y.beyond})};
}

StepTrigger FitToStrength(const StepTrigger& strong, const StepTrigger& weak,
                          const TurnStrength& strength) noexcept {
  const double sagittal = Share(kSagittal, strength.sagittal);
  const double lateral = Share(kLateral, strength.lateral);
  StepTrigger fit;
  fit.sagittal = Between(weak.sagittal, strong.sagittal, sagittal);
  fit.lateral = Between(weak.lateral, strong.lateral, lateral);
  fit.sum = Between(weak.sum, strong.sum, std::min(sagittal, lateral));
  return fit;
}

}  // namespace poise
