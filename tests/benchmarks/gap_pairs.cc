// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/benchmarks/gap_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "poise/hqp/certificate.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solver.h"
#include "poise/tests/util/random_hierarchy.h"
#include "poise/tests/util/shrink_hierarchy.h"
#include "poise/tools/commands/hqp/hqp_file.h"

namespace poise {
namespace {

double SquareIfFinite(double bound) {
  return std::isfinite(bound) ? bound * bound : 0;
}

// An answer, and Certifier::gap() of each level.
struct Answer {
  Solution solution;
  std::vector<double> gap;
};

// Small hierarchies of mixed scales. One third have columns like those of
// joints of small mass.
RandomHierarchyOptions MixedScales() {
  RandomHierarchyOptions options;
  options.max_variables = 8;
  options.max_levels = 4;
  options.max_equalities = 4;
  options.max_inequalities = 6;
  options.scaled = 40;
  options.weighted = 20;
  options.columns = 20;
  options.small_columns = 33;
  return options;
}

// Answers of the fast solver, cold and warm, and of the cascade. The warm
// solver has solved a neighbor of the hierarchy before.
struct Answers {
  Answer cold, warm, cascade;
};

Answers SolveAll(const HierarchyCase& drawn, std::uint64_t seed) {
  const int n = drawn.hierarchy.num_variables();
  Solution solution(n, drawn.capacity);
  const auto judge = [&] {
    return Answer{solution, FindGaps(drawn.hierarchy, solution)};
  };
  Solver solver(n, drawn.capacity);
  (void)solver.Solve(drawn.hierarchy, &solution);
  const Answer cold = judge();
  HierarchyCase neighbor = drawn;
  ChangeHierarchy(seed, &neighbor);
  (void)solver.Solve(neighbor.hierarchy, &solution);
  (void)solver.Solve(drawn.hierarchy, &solution);
  const Answer warm = judge();
  Cascade cascade(n, drawn.capacity);
  (void)cascade.Solve(drawn.hierarchy, &solution);
  return {cold, warm, judge()};
}

// The first level of a pair whose costs differ by more than the gaps allow.
struct Excess {
  int level;
  long double first, second;  // Costs.
  double allowed;             // Sum of the gaps.
  bool is_far;  // The cheaper answer is beyond the radius of the other's gap.
};

// The radius of Certifier::gap(): optima of a level are no farther from y.
double Radius(const Hierarchy& hierarchy, int level, const Eigen::VectorXd& y) {
  double farthest = 0;
  for (int k = 0; k <= level; ++k) {
    const auto B = hierarchy.B(k), C = hierarchy.C(k);
    for (int i = 0; i < B.rows(); ++i) {
      const double norm = B.row(i).norm();
      if (hierarchy.weight(k)[i] == 0 || norm == 0) continue;
      farthest = std::max(farthest, std::abs(hierarchy.b(k)[i]) / norm);
    }
    for (int i = 0; i < C.rows(); ++i) {
      const double norm = C.row(i).norm(), value = C.row(i).dot(y);
      const double lower = hierarchy.lower(k)[i], upper = hierarchy.upper(k)[i];
      if (norm == 0 || (value >= lower && value <= upper)) continue;
      const double bound = value < lower ? lower : upper;
      farthest = std::max(farthest, std::abs(bound) / norm);
    }
  }
  return 2 * (y.norm() + farthest);
}

std::optional<Excess> FindExcess(const Hierarchy& hierarchy, const Answer& a,
                                 const Answer& b) {
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    const long double first = TrueCost(hierarchy, level, a.solution.y);
    const long double second = TrueCost(hierarchy, level, b.solution.y);
    const double allowed = a.gap[level] + b.gap[level];
    // A comparison with NaN is false, and counts as an excess.
    if (!(std::abs(first - second) <= allowed)) {
      const Eigen::VectorXd& costly = (first > second ? a : b).solution.y;
      const double distance = (a.solution.y - b.solution.y).norm();
      return Excess{level, first, second, allowed,
                    distance > Radius(hierarchy, level, costly)};
    }
  }
  return std::nullopt;
}

// Returns the excess of pair 0 (warm and cold) or pair 1 (cascade and cold).
std::optional<Excess> FindExcess(const HierarchyCase& drawn,
                                 const Answers& answers, int pair) {
  return FindExcess(drawn.hierarchy, pair == 0 ? answers.warm : answers.cascade,
                    answers.cold);
}

void Print(const HierarchyCase& drawn, std::uint64_t seed, int pair,
           const Excess& excess, const Answers& answers) {
  const Solution& other = (pair == 0 ? answers.warm : answers.cascade).solution;
  std::printf(
      "seed %llu, %s and cold (%s, %s), %d variables, %d levels, level %d: "
      "costs %.17Lg and %.17Lg, difference %.3Lg, gaps %.3g%s\n",
      static_cast<unsigned long long>(seed), pair == 0 ? "warm" : "cascade",
      Name(other.status).c_str(), Name(answers.cold.solution.status).c_str(),
      drawn.hierarchy.num_variables(), drawn.hierarchy.num_levels(),
      excess.level, excess.first, excess.second, excess.first - excess.second,
      excess.allowed, excess.is_far ? ", beyond the radius" : "");
}

void PrintShrunk(const HierarchyCase& drawn, std::uint64_t seed, int pair,
                 bool is_far) {
  const HierarchyCase shrunk =
      ShrinkHierarchy(drawn, [&](const HierarchyCase& each) {
        const HierarchyCase roomy = WithRoomToChange(each);
        const auto excess = FindExcess(roomy, SolveAll(roomy, seed), pair);
        return excess && excess->is_far == is_far;
      });
  const HierarchyCase roomy = WithRoomToChange(shrunk);
  const Answers answers = SolveAll(roomy, seed);
  std::cout << "  shrunk: " << std::flush;
  Print(roomy, seed, pair, *FindExcess(roomy, answers, pair), answers);
  std::cout << "  " << WriteHqp(shrunk.hierarchy) << std::endl;
}

}  // namespace

long double TrueCost(const Hierarchy& hierarchy, int level,
                     const Eigen::VectorXd& y) {
  const auto value = [&](const auto& rows, int i) {
    long double sum = 0;
    for (int j = 0; j < y.size(); ++j) {
      sum += static_cast<long double>(rows(i, j)) * y[j];
    }
    return sum;
  };
  long double twice = 0;
  const auto B = hierarchy.B(level), C = hierarchy.C(level);
  for (int i = 0; i < B.rows(); ++i) {
    const long double residual = value(B, i) + hierarchy.b(level)[i];
    twice += hierarchy.weight(level)[i] * residual * residual;
  }
  for (int i = 0; i < C.rows(); ++i) {
    const long double at = value(C, i);
    const long double below = hierarchy.lower(level)[i] - at;
    const long double above = at - hierarchy.upper(level)[i];
    const long double slack = std::max({below, above, 0.0L});
    twice += slack * slack;
  }
  return twice / 2;
}

double CostFloor(const Hierarchy& hierarchy, int level) {
  double size = 0;
  for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
    const double b = hierarchy.b(level)[i];
    size += hierarchy.weight(level)[i] * b * b;
  }
  for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
    size += SquareIfFinite(hierarchy.lower(level)[i]) +
            SquareIfFinite(hierarchy.upper(level)[i]);
  }
  return 1e-6 * (1 + size / 2);
}

int CompareRandomPairs(std::uint64_t first_seed, int hierarchies) {
  const RandomHierarchyOptions options = MixedScales();
  int exceeding[2][2] = {}, optimal[2] = {};  // By pair and Excess::is_far.
  for (int i = 0; i < hierarchies; ++i) {
    const std::uint64_t seed = first_seed + i;
    const HierarchyCase drawn =
        WithRoomToChange(MakeRandomHierarchy(seed, options));
    const Answers answers = SolveAll(drawn, seed);
    for (const int pair : {0, 1}) {
      const Answer& other = pair == 0 ? answers.warm : answers.cascade;
      optimal[pair] += other.solution.status == Status::kOptimal &&
                       answers.cold.solution.status == Status::kOptimal;
      const auto excess = FindExcess(drawn, answers, pair);
      if (!excess) continue;
      Print(drawn, seed, pair, *excess, answers);
      const bool is_far = excess->is_far;
      if (exceeding[0][is_far] + exceeding[1][is_far] == 0) {
        PrintShrunk(drawn, seed, pair, is_far);
      }
      ++exceeding[pair][is_far];
    }
  }
  for (const int pair : {0, 1}) {
    std::printf(
        "%s and cold: %d pairs, %d of them both optimal; %d differ by more "
        "than their gaps within the radius, %d beyond it\n",
        pair == 0 ? "warm" : "cascade", hierarchies, optimal[pair],
        exceeding[pair][0], exceeding[pair][1]);
  }
  return exceeding[0][0] + exceeding[1][0];
}

void PrintTicksThatDiffer(const RecordingConditions& conditions) {
  std::unique_ptr<Solver> warm, cold;
  std::vector<LevelCapacity> capacity;
  int tick = 0, differing = 0, both = 0;
  std::printf("tick  level  warm cost  cold cost  difference  gaps\n");
  VisitTicks(conditions, [&](const Controller& controller) {
    const Hierarchy& hierarchy = controller.hierarchy();
    const int n = hierarchy.num_variables();
    if (!warm) {
      capacity = controller.stack().capacity();
      const int rows = controller.stack().max_leading_rows();
      warm = std::make_unique<Solver>(n, capacity, rows);
      cold = std::make_unique<Solver>(n, capacity, rows);
    }
    Solution a(n, capacity), b(n, capacity);
    const Status first = warm->Solve(hierarchy, &a);
    cold->Forget();
    const Status second = cold->Solve(hierarchy, &b);
    ++tick;
    if (first != Status::kOptimal || second != Status::kOptimal) return;
    ++both;
    bool differs = false;
    const std::vector<double> gap[] = {FindGaps(hierarchy, a),
                                       FindGaps(hierarchy, b)};
    for (int k = 0; k < hierarchy.num_levels(); ++k) {
      const long double warm_cost = TrueCost(hierarchy, k, a.y);
      const long double cold_cost = TrueCost(hierarchy, k, b.y);
      const long double size = std::max<long double>(
          std::max(warm_cost, cold_cost), CostFloor(hierarchy, k));
      if (std::abs(warm_cost - cold_cost) <= 1e-6 * size) continue;
      differs = true;
      std::printf("%4d  %d  %.9Lg  %.9Lg  %.2Le  %.2e %.2e\n", tick,
                  controller.stack().priority_level(k), warm_cost, cold_cost,
                  warm_cost - cold_cost, gap[0][k], gap[1][k]);
    }
    differing += differs;
  });
  std::printf("%d of %d ticks differ; both solves are optimal in %d\n",
              differing, tick, both);
}

}  // namespace poise
