// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tests/util/compare_solvers.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "hqp/cascade.h"
#include "hqp/certificate.h"
#include "hqp/solver.h"
#include "math/rank.h"

namespace poise {
namespace {

// Of the rows that make y what it is, each to unit length.
double ConditionOfActiveRows(const Hierarchy& hierarchy,
                             const Solution& solution) {
  Eigen::MatrixXd rows(0, hierarchy.num_variables());
  const auto add = [&rows](const Eigen::RowVectorXd& row) {
    if (row.norm() == 0) return;
    rows.conservativeResize(rows.rows() + 1, Eigen::NoChange);
    rows.bottomRows(1) = row.normalized();
  };
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    for (int i = 0; i < hierarchy.num_equalities(k); ++i) {
      if (hierarchy.weight(k)[i] > 0) add(hierarchy.B(k).row(i));
    }
    for (int i = 0; i < hierarchy.num_inequalities(k); ++i) {
      if (solution.levels[k].active[i] != Side::kNone) {
        add(hierarchy.C(k).row(i));
      }
    }
  }
  if (rows.rows() == 0) return 1;
  RankRevealing svd(static_cast<int>(rows.rows()),
                    static_cast<int>(rows.cols()));
  svd.Compute(rows);
  return svd.condition();
}

// The largest |b| / |row|: rounding of y is relative to it where y is less.
double LargestWish(const Hierarchy& hierarchy) {
  double largest = 0;
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    for (int i = 0; i < hierarchy.num_equalities(k); ++i) {
      const double norm = hierarchy.B(k).row(i).norm();
      if (hierarchy.weight(k)[i] == 0 || norm == 0) continue;
      largest = std::max(largest, std::abs(hierarchy.b(k)[i]) / norm);
    }
  }
  return largest;
}

// The largest difference of residuals and slacks that count.
double ResidualDifference(const Hierarchy& hierarchy, int level,
                          const LevelSolution& a, const LevelSolution& b) {
  double largest = 0;
  for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
    largest = std::max(
        largest, std::sqrt(hierarchy.weight(level)[i]) *
                     std::abs(a.equality_residual[i] - b.equality_residual[i]));
  }
  for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
    largest = std::max(largest, std::abs(a.slack[i] - b.slack[i]));
  }
  return largest;
}

}  // namespace

std::string Disagreement(const HierarchyCase& drawn, double tolerance,
                         Solver* living) {
  const Hierarchy& hierarchy = drawn.hierarchy;
  const int n = hierarchy.num_variables();
  Solution fast(n, drawn.capacity), reference(n, drawn.capacity);
  Certifier certifier(n, drawn.capacity);
  std::ostringstream text;
  const auto judge = [&](const std::string& what, double error,
                         double allowed) {
    if (!(error <= allowed)) {
      text << what << " " << error << " > " << allowed << "; ";
    }
  };
  if (Cascade(n, drawn.capacity).Solve(hierarchy, &reference) !=
      Status::kOptimal) {
    text << "the cascade has no optimum; ";
  }
  judge("the cascade's certificate",
        certifier.Certify(hierarchy, reference).worst(), tolerance);
  const double eps = std::numeric_limits<double>::epsilon();
  const double same_y =
      std::max(tolerance,
               100 * eps * ConditionOfActiveRows(hierarchy, reference)) *
          reference.y.norm() +
      4 * eps * LargestWish(hierarchy);
  const auto compare = [&](const std::string& name, Solver* solver) {
    if (solver->Solve(hierarchy, &fast) != Status::kOptimal) {
      text << name << " has no optimum; ";
    }
    judge(name + "'s certificate", certifier.Certify(hierarchy, fast).worst(),
          tolerance);
    for (int k = 0; k < hierarchy.num_levels(); ++k) {
      const LevelSolution &a = fast.levels[k], &b = reference.levels[k];
      const double size = CostSize(hierarchy, k, reference);
      const std::string of = " on level " + std::to_string(k);
      judge(name + "'s cost" + of, std::abs(a.cost - b.cost), tolerance * size);
      judge(name + "'s residual or slack" + of,
            ResidualDifference(hierarchy, k, a, b),
            tolerance * std::sqrt(size));
      if (a.nullity != b.nullity) {
        text << name << "'s nullity" << of << " " << a.nullity << ", not "
             << b.nullity << "; ";
      }
    }
    judge(name + "'s y", (fast.y - reference.y).norm(), same_y);
    judge(name + "'s y is not the shortest",
          CertifyShortest(drawn, fast).worst(), tolerance);
  };
  Solver fresh(n, drawn.capacity);
  compare("the fast solver", &fresh);
  if (living != nullptr) compare("the living solver", living);
  return text.str();
}

Certificate CertifyShortest(const HierarchyCase& drawn,
                            const Solution& solution) {
  const Hierarchy& from = drawn.hierarchy;
  const int n = from.num_variables(), levels = from.num_levels();
  std::vector<LevelCapacity> capacity(drawn.capacity.begin(),
                                      drawn.capacity.begin() + levels);
  capacity.push_back({n, 0});
  Hierarchy hierarchy(n, capacity);
  for (int k = 0; k < levels; ++k) {
    EqualityBlock equalities =
        hierarchy.AddEqualities(k, from.num_equalities(k));
    equalities.B = from.B(k);
    equalities.b = from.b(k);
    equalities.weight = from.weight(k);
    InequalityBlock inequalities =
        hierarchy.AddInequalities(k, from.num_inequalities(k));
    inequalities.C = from.C(k);
    inequalities.lower = from.lower(k);
    inequalities.upper = from.upper(k);
  }
  hierarchy.AddEqualities(levels, n).B.setIdentity();
  Solution judged(n, capacity);
  if (Solver(n, capacity).Solve(hierarchy, &judged) != Status::kOptimal) {
    (void)Cascade(n, capacity).Solve(hierarchy, &judged);
  }
  judged.y = solution.y;
  judged.failed_level = -1;
  for (int k = 0; k <= levels; ++k) EvaluateLevel(hierarchy, k, &judged);
  return Certifier(n, capacity).Certify(hierarchy, judged);
}

}  // namespace poise
