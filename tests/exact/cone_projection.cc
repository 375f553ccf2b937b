// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/exact/cone_projection.h"

namespace poise {
namespace {

// Returns multipliers of least |gradient + rows' multipliers|^2.
RationalVector LeastSquares(const RationalVector& gradient,
                            const RationalMatrix& rows) {
  const size_t size = rows.size();
  RationalMatrix normal(size, RationalVector(size));
  RationalVector right(size);
  for (size_t i = 0; i < size; ++i) {
    for (size_t j = 0; j < size; ++j) normal[i][j] = Dot(rows[i], rows[j]);
    right[i] = -Dot(rows[i], gradient);
  }
  return SolveLinear(normal, right, static_cast<int>(size)).value();
}

class Projection {
 public:
  Projection(const RationalVector& gradient, const RationalMatrix& E,
             const RationalMatrix& G)
      : gradient_(gradient), E_(E), G_(G), is_free_(G.size(), false) {
    result_.equality.resize(E.size());
    result_.inequality.resize(G.size());
  }

  ConeProjection Compute() {
    Release();
    while (FreeOneMore()) {
      while (!Release()) {
      }
    }
    return result_;
  }

 private:
  // Moves the multipliers towards their least-squares values, until the first
  // of G becomes zero. Returns whether they arrived.
  bool Release() {
    RationalMatrix rows = E_;
    std::vector<int> free;
    for (size_t i = 0; i < G_.size(); ++i) {
      if (!is_free_[i]) continue;
      free.push_back(static_cast<int>(i));
      rows.push_back(G_[i]);
    }
    const RationalVector target = LeastSquares(gradient_, rows);
    Rational part = 1;
    for (size_t i = 0; i < free.size(); ++i) {
      const Rational& from = result_.inequality[free[i]];
      const Rational& to = target[E_.size() + i];
      if (to < 0 && from / (from - to) < part) part = from / (from - to);
    }
    for (size_t i = 0; i < E_.size(); ++i) result_.equality[i] = target[i];
    for (size_t i = 0; i < free.size(); ++i) {
      Rational& multiplier = result_.inequality[free[i]];
      multiplier += part * (target[E_.size() + i] - multiplier);
      if (multiplier == 0) is_free_[free[i]] = false;
    }
    return part == 1;
  }

  // Frees the multiplier of the first row that the direction violates. Returns
  // false if there is none.
  bool FreeOneMore() {
    RationalVector& direction = result_.direction;
    direction.assign(gradient_.size(), 0);
    AddTo(-1, gradient_, &direction);
    for (size_t i = 0; i < E_.size(); ++i) {
      AddTo(-result_.equality[i], E_[i], &direction);
    }
    for (size_t i = 0; i < G_.size(); ++i) {
      AddTo(-result_.inequality[i], G_[i], &direction);
    }
    for (size_t i = 0; i < G_.size(); ++i) {
      if (Dot(G_[i], direction) > 0) {
        is_free_[i] = true;
        return true;
      }
    }
    return false;
  }

  const RationalVector& gradient_;
  const RationalMatrix &E_, &G_;
  std::vector<bool> is_free_;  // Multipliers of G that may be positive.
  ConeProjection result_;
};

}  // namespace

ConeProjection ProjectOntoCone(const RationalVector& gradient,
                               const RationalMatrix& E,
                               const RationalMatrix& G) {
  return Projection(gradient, E, G).Compute();
}

}  // namespace poise
