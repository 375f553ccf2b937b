// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/reference/cascade.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/hqp/tolerances.h"
#include "poise/math/rank.h"

namespace poise {
namespace {

// Largest number of passes. Two are enough for the rows of a robot.
constexpr int kPasses = 3;

// Returns the magnitude that rounding of row i of C y is relative to.
double Size(const Hierarchy& hierarchy, int level, int i, double bound,
            const Eigen::VectorXd& y) {
  return hierarchy.C(level).row(i).norm() * y.norm() +
         (std::isinf(bound) ? 0 : std::abs(bound));
}

Side SideOf(const Hierarchy& hierarchy, int level, int i, double margin,
            const Eigen::VectorXd& y) {
  const double value = hierarchy.C(level).row(i).dot(y);
  const double lower = hierarchy.lower(level)[i];
  const double upper = hierarchy.upper(level)[i];
  if (value - upper > margin * Size(hierarchy, level, i, upper, y)) {
    return Side::kUpper;
  }
  if (lower - value > margin * Size(hierarchy, level, i, lower, y)) {
    return Side::kLower;
  }
  return Side::kNone;
}

// Returns whether y is strictly inside the bound of row i on that side.
bool IsInside(const Hierarchy& hierarchy, int level, int i, Side side,
              const Eigen::VectorXd& y) {
  if (side == Side::kNone) return true;
  const double bound = side == Side::kUpper ? hierarchy.upper(level)[i]
                                            : hierarchy.lower(level)[i];
  const double beyond =
      static_cast<double>(side) * (hierarchy.C(level).row(i).dot(y) - bound);
  return beyond < -tolerances::kAtBound * Size(hierarchy, level, i, bound, y);
}

// Adds the step to y. Entries of y within rounding of the largest entry of the
// step become zero. Otherwise all terms of a row with only such entries would
// be rounding.
void AddStep(const Eigen::VectorXd& step, Eigen::VectorXd* y) {
  *y += step;
  const double rounding = static_cast<double>(y->size()) *
                          std::numeric_limits<double>::epsilon() *
                          step.lpNorm<Eigen::Infinity>();
  *y = (y->array().abs() <= rounding).select(0, *y);
}

// Returns the gradient of the level's cost at y.
Eigen::VectorXd Gradient(const Hierarchy& hierarchy, int level,
                         const LevelSolution& own, const Eigen::VectorXd& y) {
  Eigen::VectorXd gradient =
      hierarchy.B(level).transpose() *
      hierarchy.weight(level).cwiseProduct(
          own.equality_residual.head(hierarchy.num_equalities(level)));
  for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
    const Side side = SideOf(hierarchy, level, i, 0, y);
    gradient += static_cast<double>(side) * own.slack[i] *
                hierarchy.C(level).row(i).transpose();
  }
  return gradient;
}

// Returns the magnitude of the terms of the gradient, by variable.
Eigen::VectorXd GradientSize(const Hierarchy& hierarchy, int level,
                             const LevelSolution& own,
                             const Eigen::VectorXd& y) {
  const Eigen::VectorXd abs_y = y.cwiseAbs();
  Eigen::VectorXd size = Eigen::VectorXd::Zero(y.size());
  for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
    const Eigen::VectorXd row =
        hierarchy.B(level).row(i).cwiseAbs().transpose();
    size += hierarchy.weight(level)[i] *
            (row.dot(abs_y) + std::abs(hierarchy.b(level)[i])) * row;
  }
  for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
    if (own.slack[i] == 0) continue;
    const Eigen::VectorXd row =
        hierarchy.C(level).row(i).cwiseAbs().transpose();
    size += (row.dot(abs_y) + own.slack[i]) * row;
  }
  return size;
}

}  // namespace

Cascade::Cascade(int num_variables, const std::vector<LevelCapacity>& capacity,
                 RowSpaceMethod nullspace)
    : method_(nullspace),
      certifier_(num_variables, capacity),
      Z_(num_variables, num_variables) {
  violated_.resize(capacity.size());
  for (size_t level = 0; level < capacity.size(); ++level) {
    violated_[level].assign(capacity[level].inequalities, Side::kNone);
  }
}

Status Cascade::Solve(const Hierarchy& hierarchy, Solution* solution) noexcept {
  solution->Reset();
  int failed_level;
  const Status status = CheckInput(hierarchy, &failed_level);
  if (status != Status::kOptimal) {
    return Refuse(hierarchy, status, failed_level, solution);
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    SolveFromY(hierarchy, solution);
    if (!solution->y.allFinite()) {
      return Refuse(hierarchy, Status::kNotFinite, 0, solution);
    }
    if (solution->status != Status::kOptimal) break;
    certifier_.Certify(hierarchy, solution);
    if (solution->certificate.worst() <= Certifier::kCertified) {
      return solution->status;
    }
  }
  certifier_.Truncate(hierarchy, solution);
  return solution->status;
}

// Writes y = 0. The gaps of an invalid hierarchy stay infinite.
Status Cascade::Refuse(const Hierarchy& hierarchy, Status status,
                       int failed_level, Solution* solution) {
  solution->Reset();
  solution->status = status;
  solution->failed_level = failed_level;
  solution->certificate = certifier_.Certify(hierarchy, *solution);
  return status;
}

// Makes one pass, from solution->y. The steps of the second pass are small, and
// so is their rounding.
void Cascade::SolveFromY(const Hierarchy& hierarchy, Solution* solution) {
  const int n = hierarchy.num_variables();
  const int iterations = solution->iterations;
  const Eigen::VectorXd y = solution->y;
  solution->Reset();
  solution->iterations = iterations;
  solution->y = y;
  Z_.setIdentity(n, n);
  // One more level, y = 0, selects the optimum of minimum norm.
  for (int level = 0; level <= hierarchy.num_levels(); ++level) {
    if (!SolveLevel(hierarchy, level, solution)) {
      solution->status = Status::kIterationLimit;
      solution->failed_level = level;
      break;
    }
    if (level < hierarchy.num_levels()) FixLevel(hierarchy, level, solution);
  }
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    const double solved_to = solution->levels[level].cost;
    EvaluateLevel(hierarchy, level, solution);
    if (solution->failed_level < 0 || level < solution->failed_level) {
      solution->levels[level].cost = solved_to;
    }
    // A row of the working set is active if it is still at its bound.
    std::vector<Side>& active = solution->levels[level].active;
    for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
      if (IsInside(hierarchy, level, i, active[i], solution->y)) {
        active[i] = Side::kNone;
      }
    }
  }
}

// Solves one QP, (5) and (6), in the u of (3), here z: the new y is y + Z z.
bool Cascade::SolveLevel(const Hierarchy& hierarchy, int level,
                         Solution* solution) {
  const std::vector<RowIndex> rows = FindRows(hierarchy, level);
  LevelQp qp;
  qp.z.setZero(Z_.cols());
  SetCost(hierarchy, level, solution->y, &qp);
  SetBounds(hierarchy, level, rows, solution->y, &qp);
  const int iterations =
      SolveLevelQp(method_, max_iterations - solution->iterations, &qp);
  if (iterations < 0) {
    solution->iterations = max_iterations;
    return false;
  }
  solution->iterations += iterations;
  AddStep(Z_ * qp.z, &solution->y);
  active_.clear();
  for (size_t r = 0; r < rows.size(); ++r) {
    if (qp.side[r] == Side::kNone) continue;
    const auto [from, i] = rows[r];
    active_.push_back({from, i});
    solution->levels[from].active[i] = qp.side[r];
  }
  return true;
}

// Returns the rows of (6): the level's own inequalities, and those inherited
// ones that are not equalities. Rows that depend on the levels above are left
// out.
std::vector<Cascade::RowIndex> Cascade::FindRows(const Hierarchy& hierarchy,
                                                 int level) const {
  std::vector<RowIndex> rows;
  for (int from = 0; from <= level && from < hierarchy.num_levels(); ++from) {
    for (int i = 0; i < hierarchy.num_inequalities(from); ++i) {
      const auto C_i = hierarchy.C(from).row(i);
      if ((from < level && violated_[from][i] != Side::kNone) ||
          (C_i * Z_).norm() <= kRankTolerance * C_i.norm()) {
        continue;
      }
      rows.push_back({from, i});
    }
  }
  return rows;
}

// Sets the cost (5): the level's own equalities, or y after the last level.
void Cascade::SetCost(const Hierarchy& hierarchy, int level,
                      const Eigen::VectorXd& y, LevelQp* qp) const {
  if (level == hierarchy.num_levels()) {
    qp->M = Z_;
    qp->m = y;
    qp->M_norm.setOnes(hierarchy.num_variables());
    qp->M_size = y.cwiseAbs();
    return;
  }
  const Eigen::VectorXd root = hierarchy.weight(level).cwiseSqrt();
  const Eigen::MatrixXd B = root.asDiagonal() * hierarchy.B(level);
  qp->M = B * Z_;
  qp->m = B * y + root.cwiseProduct(hierarchy.b(level));
  qp->M_norm = B.rowwise().norm();
  qp->M_size =
      y.norm() * qp->M_norm + root.cwiseProduct(hierarchy.b(level).cwiseAbs());
}

// Sets the constraints (6): the level's own rows are soft, with the slack v;
// the inherited rows (4) are hard.
void Cascade::SetBounds(const Hierarchy& hierarchy, int level,
                        const std::vector<RowIndex>& rows,
                        const Eigen::VectorXd& y, LevelQp* qp) const {
  const int count = static_cast<int>(rows.size());
  qp->P.resize(count, Z_.cols());
  for (Eigen::VectorXd* column :
       {&qp->value, &qp->lower, &qp->upper, &qp->P_norm, &qp->size}) {
    column->resize(count);
  }
  for (int r = 0; r < count; ++r) {
    const auto [from, i] = rows[r];
    const auto C_i = hierarchy.C(from).row(i);
    const double lower = hierarchy.lower(from)[i];
    const double upper = hierarchy.upper(from)[i];
    const double value = C_i.dot(y);
    qp->P.row(r) = C_i * Z_;
    qp->P_norm[r] = C_i.norm();
    qp->size[r] = std::max(Size(hierarchy, from, i, lower, y),
                           Size(hierarchy, from, i, upper, y));
    qp->value[r] = value;
    const bool soft = from == level;
    qp->soft.push_back(soft);
    qp->side.push_back(soft ? SideOf(hierarchy, from, i, 0, y) : Side::kNone);
    // A hard row has the slack v* of this y, so that z = 0 is feasible.
    qp->lower[r] = soft ? lower : std::min(lower, value);
    qp->upper[r] = soft ? upper : std::max(upper, value);
  }
}

void Cascade::FixLevel(const Hierarchy& hierarchy, int level,
                       Solution* solution) {
  EvaluateLevel(hierarchy, level, solution);
  FindMultipliers(hierarchy, level, solution);

  // Update (3), Z <- Z null(B Z), with the violated rows in B.
  const int equalities = hierarchy.num_equalities(level);
  std::vector<int> violated;
  for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
    violated_[level][i] =
        SideOf(hierarchy, level, i, tolerances::kAtBound, solution->y);
    if (violated_[level][i] == Side::kNone) continue;
    violated.push_back(i);
    // A row that depends on the levels above was in no QP. A row of zeros is
    // never active.
    if (hierarchy.C(level).row(i).norm() > 0) {
      solution->levels[level].active[i] = violated_[level][i];
    }
  }
  Eigen::MatrixXd B(equalities + violated.size(), hierarchy.num_variables());
  B.topRows(equalities) = hierarchy.B(level);
  for (int i = 0; i < equalities; ++i) {
    if (hierarchy.weight(level)[i] == 0) B.row(i).setZero();
  }
  for (size_t i = 0; i < violated.size(); ++i) {
    B.row(equalities + i) = hierarchy.C(level).row(violated[i]);
  }
  for (int i = 0; i < B.rows(); ++i) {
    const double norm = B.row(i).norm();
    if (norm > 0) B.row(i) /= norm;
  }
  const RowSpace space = MakeRowSpace(B * Z_, method_);
  Z_ = (Z_ * space.V.rightCols(Z_.cols() - space.rank)).eval();
  solution->levels[level].nullity = static_cast<int>(Z_.cols());
}

// Finds the multipliers for which the gradient of the level's cost vanishes.
void Cascade::FindMultipliers(const Hierarchy& hierarchy, int level,
                              Solution* solution) {
  const LevelSolution& own = solution->levels[level];
  const std::vector<Carrier> carriers = FindCarriers(hierarchy, level);
  if (carriers.empty()) return;
  const Eigen::VectorXd gradient = Gradient(hierarchy, level, own, solution->y);
  const Eigen::VectorXd size = GradientSize(hierarchy, level, own, solution->y);
  // The gradient of a level that is met is rounding.
  if (gradient.norm() <= kNegligible * size.norm()) return;

  const int count = static_cast<int>(carriers.size());
  Eigen::MatrixXd E(hierarchy.num_variables(), count);
  Eigen::VectorXd norms(count);
  for (int c = 0; c < count; ++c) {
    const auto [from, i, is_equality] = carriers[c];
    if (is_equality) {
      E.col(c) = hierarchy.B(from).row(i).transpose();
    } else {
      E.col(c) = hierarchy.C(from).row(i).transpose();
    }
    norms[c] = E.col(c).norm();
    if (norms[c] > 0) E.col(c) /= norms[c];
  }
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> cod;
  cod.setThreshold(kRankTolerance);
  cod.compute(E);
  const Eigen::VectorXd multipliers = cod.solve(-gradient);
  for (int c = 0; c < count; ++c) {
    const auto [from, i, is_equality] = carriers[c];
    LevelMultipliers& out = solution->levels[level].multipliers[from];
    const double value = norms[c] > 0 ? multipliers[c] / norms[c] : 0;
    (is_equality ? out.equality : out.inequality)[i] = value;
  }
}

// Returns the rows of the levels above that can have a multiplier: equalities
// with a positive weight, violated rows, and the working set of this level's
// QP.
std::vector<Cascade::Carrier> Cascade::FindCarriers(const Hierarchy& hierarchy,
                                                    int level) const {
  std::vector<Carrier> carriers;
  for (int from = 0; from < level; ++from) {
    for (int i = 0; i < hierarchy.num_equalities(from); ++i) {
      if (hierarchy.weight(from)[i] == 0) continue;
      carriers.push_back({from, i, true});
    }
    for (int i = 0; i < hierarchy.num_inequalities(from); ++i) {
      const bool active =
          std::find_if(active_.begin(), active_.end(), [&](RowIndex row) {
            return row.level == from && row.row == i;
          }) != active_.end();
      if (active || violated_[from][i] != Side::kNone) {
        carriers.push_back({from, i, false});
      }
    }
  }
  return carriers;
}

}  // namespace poise
