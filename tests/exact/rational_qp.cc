// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/exact/rational_qp.h"

#include "poise/tests/exact/cone_projection.h"

namespace poise {
namespace {

RationalVector Gradient(const RationalQp& qp, const RationalVector& x) {
  RationalVector gradient(x.size());
  for (size_t i = 0; i < qp.F.size(); ++i) {
    AddTo(qp.weight[i] * (Dot(qp.F[i], x) + qp.f[i]), qp.F[i], &gradient);
  }
  return gradient;
}

// Returns p'Hp with the Hessian H = F' weight F of the cost.
Rational Curvature(const RationalQp& qp, const RationalVector& p) {
  Rational curvature = 0;
  for (size_t i = 0; i < qp.F.size(); ++i) {
    const Rational product = Dot(qp.F[i], p);
    curvature += qp.weight[i] * product * product;
  }
  return curvature;
}

std::vector<int> ActiveRows(const RationalQp& qp, const RationalVector& x) {
  std::vector<int> active;
  for (size_t i = 0; i < qp.G.size(); ++i) {
    if (Dot(qp.G[i], x) == qp.g[i]) active.push_back(static_cast<int>(i));
  }
  return active;
}

// Returns a step to a minimum with E x and the active rows kept constant. It
// solves H p + A' multipliers = -gradient, A p = 0, where A has these rows. The
// system always has a solution, because a sum of squares has a minimum.
RationalVector StepOnActiveRows(const RationalQp& qp,
                                const std::vector<int>& active,
                                const RationalVector& gradient) {
  RationalMatrix A = qp.E;
  for (const int i : active) A.push_back(qp.G[i]);
  const int n = static_cast<int>(gradient.size());
  const int size = n + static_cast<int>(A.size());
  RationalMatrix system(size, RationalVector(size));
  RationalVector right(size);
  for (size_t i = 0; i < qp.F.size(); ++i) {
    for (int j = 0; j < n; ++j) {
      AddTo(qp.weight[i] * qp.F[i][j], qp.F[i], &system[j]);
    }
  }
  for (int i = n; i < size; ++i) {
    for (int j = 0; j < n; ++j) system[i][j] = system[j][i] = A[i - n][j];
  }
  for (int j = 0; j < n; ++j) right[j] = -gradient[j];
  RationalVector step = SolveLinear(system, right, size).value();
  step.resize(n);
  return step;
}

// Returns the step length to the minimum of the cost along p, or to the first
// blocking constraint. The cost falls along p, so its curvature is not zero: a
// sum of squares does not fall for ever.
Rational StepLength(const RationalQp& qp, const RationalVector& x,
                    const RationalVector& gradient, const RationalVector& p) {
  Rational length = -Dot(gradient, p) / Curvature(qp, p);
  for (size_t i = 0; i < qp.G.size(); ++i) {
    const Rational slope = Dot(qp.G[i], p);
    if (slope <= 0) continue;
    const Rational blocked = (qp.g[i] - Dot(qp.G[i], x)) / slope;
    if (blocked < length) length = blocked;
  }
  return length;
}

}  // namespace

RationalQpOptimum Minimise(const RationalQp& qp, RationalVector x) {
  for (;;) {
    const RationalVector gradient = Gradient(qp, x);
    const std::vector<int> active = ActiveRows(qp, x);
    RationalVector step = StepOnActiveRows(qp, active, gradient);
    if (Dot(gradient, step) == 0) {
      RationalMatrix G;
      for (const int i : active) G.push_back(qp.G[i]);
      const ConeProjection projection = ProjectOntoCone(gradient, qp.E, G);
      if (IsZero(projection.direction)) {
        RationalVector inequality(qp.G.size());
        for (size_t i = 0; i < active.size(); ++i) {
          inequality[active[i]] = projection.inequality[i];
        }
        return {x, projection.equality, inequality};
      }
      step = projection.direction;
    }
    AddTo(StepLength(qp, x, gradient, step), step, &x);
  }
}

}  // namespace poise
