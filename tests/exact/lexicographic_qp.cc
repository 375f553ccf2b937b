// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/exact/lexicographic_qp.h"

#include <utility>

#include "poise/tests/exact/check_optimal.h"
#include "poise/tests/exact/rational_qp.h"
#include "poise/tests/exact/rational_rows.h"

namespace poise {
namespace {

// A row that the levels so far have decided. It stays constant if it is an
// equality or violated, and otherwise row y <= bound.
struct DecidedRow {
  RationalVector row;
  Rational bound;
  int level, index;
  bool is_equality;
  int sign;  // -1 for the lower bound, whose row is negated.
};

class Search {
 public:
  explicit Search(const std::vector<RationalRows>& levels)
      : levels_(levels), y_(levels.back().B.size()) {}

  ExactOptimum Solve() {
    ExactOptimum optimum;
    for (size_t k = 0; k < levels_.size(); ++k) {
      const int level = static_cast<int>(k);
      optimum.levels.push_back(SolveLevel(level));
      DecideRows(level);
      optimum.levels[k].nullity = static_cast<int>(y_.size() - fixed_.size());
    }
    optimum.y = y_;
    return optimum;
  }

 private:
  // Returns the QP of a level in x = [y; slacks]. A row has one slack for both
  // sides: C y - slack <= upper and -C y - slack <= -lower.
  RationalQp MakeQp(int level) const {
    const RationalRows& rows = levels_[level];
    const size_t n = y_.size(), size = n + rows.C.size();
    RationalQp qp{rows.B, rows.b, rows.weight, {}, {}, {}};
    for (RationalVector& row : qp.F) row.resize(size);
    for (size_t i = 0; i < rows.C.size(); ++i) {
      RationalVector slack(size);
      slack[n + i] = 1;
      qp.F.push_back(slack);
      qp.f.push_back(0);
      qp.weight.push_back(1);
    }
    for (const DecidedRow& decided : fixed_) {
      qp.E.push_back(decided.row);
      qp.E.back().resize(size);
    }
    for (const DecidedRow& decided : met_) {
      qp.G.push_back(decided.row);
      qp.G.back().resize(size);
      qp.g.push_back(decided.bound);
    }
    for (size_t i = 0; i < rows.C.size(); ++i) {
      for (const DecidedRow& side : Sides(level, static_cast<int>(i))) {
        qp.G.push_back(side.row);
        qp.G.back().resize(size);
        qp.G.back()[n + i] = -1;
        qp.g.push_back(side.bound);
      }
    }
    return qp;
  }

  // Returns the finite sides of an inequality, each as row y <= bound.
  std::vector<DecidedRow> Sides(int level, int i) const {
    const RationalRows& rows = levels_[level];
    std::vector<DecidedRow> sides;
    if (rows.upper[i]) {
      sides.push_back({rows.C[i], *rows.upper[i], level, i, false, 1});
    }
    if (rows.lower[i]) {
      RationalVector negated(rows.C[i].size());
      AddTo(-1, rows.C[i], &negated);
      sides.push_back({negated, -*rows.lower[i], level, i, false, -1});
    }
    return sides;
  }

  // Moves y to the level's optimum. The start is the optimum so far, with the
  // slacks that it needs.
  ExactLevel SolveLevel(int level) {
    const RationalRows& rows = levels_[level];
    RationalVector x = y_;
    for (size_t i = 0; i < rows.C.size(); ++i) {
      x.push_back(abs(Violation(rows, static_cast<int>(i), y_)));
    }
    const RationalQpOptimum found = Minimise(MakeQp(level), x);
    y_.assign(found.x.begin(), found.x.begin() + y_.size());
    ExactLevel answer{CostAt(rows, y_), 0, {}};
    for (int j = 0; j < level; ++j) {
      answer.multipliers.push_back({RationalVector(levels_[j].B.size()),
                                    RationalVector(levels_[j].C.size())});
    }
    for (size_t i = 0; i < fixed_.size(); ++i) {
      *MultiplierOf(fixed_[i], &answer) += fixed_[i].sign * found.equality[i];
    }
    for (size_t i = 0; i < met_.size(); ++i) {
      *MultiplierOf(met_[i], &answer) += met_[i].sign * found.inequality[i];
    }
    return answer;
  }

  static Rational* MultiplierOf(const DecidedRow& row, ExactLevel* answer) {
    ExactMultipliers& of = answer->multipliers[row.level];
    return &(row.is_equality ? of.equality : of.inequality)[row.index];
  }

  // Decides the rows of a solved level for all lower levels.
  void DecideRows(int level) {
    const RationalRows& rows = levels_[level];
    for (size_t i = 0; i < rows.B.size(); ++i) {
      if (rows.weight[i] == 0) continue;
      Fix({rows.B[i], 0, level, static_cast<int>(i), true, 1});
    }
    for (size_t i = 0; i < rows.C.size(); ++i) {
      const int index = static_cast<int>(i);
      if (Violation(rows, index, y_) != 0) {
        Fix({rows.C[i], 0, level, index, false, 1});
        continue;
      }
      for (DecidedRow& side : Sides(level, index)) {
        met_.push_back(std::move(side));
      }
    }
  }

  // Keeps a row constant. A combination of constant rows is constant already.
  void Fix(const DecidedRow& row) {
    RationalMatrix transposed(y_.size());
    for (size_t j = 0; j < y_.size(); ++j) {
      for (const DecidedRow& fixed : fixed_) {
        transposed[j].push_back(fixed.row[j]);
      }
    }
    const int count = static_cast<int>(fixed_.size());
    if (!SolveLinear(transposed, row.row, count)) fixed_.push_back(row);
  }

  const std::vector<RationalRows>& levels_;
  RationalVector y_;
  std::vector<DecidedRow> fixed_;  // Linearly independent.
  std::vector<DecidedRow> met_;
};

}  // namespace

ExactOptimum SolveExactly(const Hierarchy& hierarchy) {
  const std::vector<RationalRows> levels = MakeRationalRows(hierarchy);
  ExactOptimum optimum = Search(levels).Solve();
  CheckOptimal(hierarchy, optimum);
  return optimum;
}

}  // namespace poise
