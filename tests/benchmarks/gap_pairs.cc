// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/benchmarks/gap_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solver.h"
#include "poise/tests/exact/lexicographic_qp.h"
#include "poise/tests/util/random_hierarchy.h"
#include "poise/tests/util/shrink_hierarchy.h"
#include "poise/tools/commands/hqp/hqp_file.h"

namespace poise {
namespace {

double SquareIfFinite(double bound) {
  return std::isfinite(bound) ? bound * bound : 0;
}

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
  Solution cold, warm, cascade;
};

Answers SolveAll(const HierarchyCase& drawn, std::uint64_t seed) {
  const int n = drawn.hierarchy.num_variables();
  Solution solution(n, drawn.capacity);
  Solver solver(n, drawn.capacity);
  (void)solver.Solve(drawn.hierarchy, &solution);
  const Solution cold = solution;
  HierarchyCase neighbor = drawn;
  ChangeHierarchy(seed, &neighbor);
  (void)solver.Solve(neighbor.hierarchy, &solution);
  (void)solver.Solve(drawn.hierarchy, &solution);
  const Solution warm = solution;
  Cascade cascade(n, drawn.capacity);
  (void)cascade.Solve(drawn.hierarchy, &solution);
  return {cold, warm, solution};
}

// The reason why the gap of an answer does not cover another one.
enum class Reason {
  kNone,   ///< The gap is wrong.
  kAbove,  ///< The other one costs more on a level above than the gap there.
  kFar,    ///< The other one is beyond the radius of the gap.
  kNotFinite,  ///< An answer is not finite.
  kBelow,      ///< The other one costs less than the exact optimum.
};
constexpr int kReasons = 5;
constexpr const char* kReasonNames[] = {"gap too small", "worse above",
                                        "beyond the radius", "not finite",
                                        "below the exact optimum"};

// The first level of a pair whose costs differ by more than the gaps allow.
struct Excess {
  int level;
  long double first, second;  // Costs.
  double allowed;             // Gap of the costlier answer.
  Reason reason;
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

// Why the gap of `a` on a level need not cover `b`.
Reason FindReason(const Hierarchy& hierarchy, int level, const Solution& a,
                  const Solution& b) {
  const Eigen::VectorXd &y = a.y, &other = b.y;
  for (int k = 0; k < level; ++k) {
    if (TrueCost(hierarchy, k, other) - TrueCost(hierarchy, k, y) >
        a.levels[k].gap) {
      return Reason::kAbove;
    }
  }
  if ((other - y).norm() > Radius(hierarchy, level, y)) return Reason::kFar;
  const double optimal = SolveExactly(hierarchy).levels[level].cost.get_d();
  return TrueCost(hierarchy, level, y) - optimal <= a.levels[level].gap
             ? Reason::kBelow
             : Reason::kNone;
}

std::optional<Excess> FindExcess(const Hierarchy& hierarchy, const Solution& a,
                                 const Solution& b) {
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    const long double first = TrueCost(hierarchy, level, a.y);
    const long double second = TrueCost(hierarchy, level, b.y);
    if (!std::isfinite(static_cast<double>(first - second))) {
      return Excess{level, first, second, a.levels[level].gap,
                    Reason::kNotFinite};
    }
    const bool is_first_costly = first > second;
    const Solution& costly = is_first_costly ? a : b;
    const Solution& cheap = is_first_costly ? b : a;
    const long double difference = std::abs(first - second);
    if (difference <= costly.levels[level].gap) continue;
    const Reason reason = FindReason(hierarchy, level, costly, cheap);
    if (reason == Reason::kNone ||
        difference > a.levels[level].gap + b.levels[level].gap) {
      return Excess{level, first, second, costly.levels[level].gap, reason};
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
  const Solution& other = pair == 0 ? answers.warm : answers.cascade;
  std::printf(
      "seed %llu, %s and cold (%s, %s), %d variables, %d levels, level %d: "
      "costs %.17Lg and %.17Lg, difference %.3Lg, gap %.3g: %s\n",
      static_cast<unsigned long long>(seed), pair == 0 ? "warm" : "cascade",
      Name(other.status).c_str(), Name(answers.cold.status).c_str(),
      drawn.hierarchy.num_variables(), drawn.hierarchy.num_levels(),
      excess.level, excess.first, excess.second, excess.first - excess.second,
      excess.allowed, kReasonNames[static_cast<int>(excess.reason)]);
}

void PrintShrunk(const HierarchyCase& drawn, std::uint64_t seed, int pair,
                 Reason reason) {
  const HierarchyCase shrunk =
      ShrinkHierarchy(drawn, [&](const HierarchyCase& each) {
        const HierarchyCase roomy = WithRoomToChange(each);
        const auto excess = FindExcess(roomy, SolveAll(roomy, seed), pair);
        return excess && excess->reason == reason;
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
  int exceeding[2][kReasons] = {}, optimal[2] = {};  // By pair.
  for (int i = 0; i < hierarchies; ++i) {
    const std::uint64_t seed = first_seed + i;
    const HierarchyCase drawn =
        WithRoomToChange(MakeRandomHierarchy(seed, options));
    const Answers answers = SolveAll(drawn, seed);
    for (const int pair : {0, 1}) {
      const Solution& other = pair == 0 ? answers.warm : answers.cascade;
      optimal[pair] += other.status == Status::kOptimal &&
                       answers.cold.status == Status::kOptimal;
      const auto excess = FindExcess(drawn, answers, pair);
      if (!excess) continue;
      Print(drawn, seed, pair, *excess, answers);
      const int reason = static_cast<int>(excess->reason);
      if (exceeding[0][reason] + exceeding[1][reason] == 0) {
        PrintShrunk(drawn, seed, pair, excess->reason);
      }
      ++exceeding[pair][reason];
    }
  }
  for (const int pair : {0, 1}) {
    std::printf("%s and cold: %d pairs, %d of them both optimal. Exceeding:",
                pair == 0 ? "warm" : "cascade", hierarchies, optimal[pair]);
    for (int reason = 0; reason < kReasons; ++reason) {
      std::printf(" %d %s%s", exceeding[pair][reason], kReasonNames[reason],
                  reason + 1 < kReasons ? "," : "\n");
    }
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
    for (int k = 0; k < hierarchy.num_levels(); ++k) {
      const long double warm_cost = TrueCost(hierarchy, k, a.y);
      const long double cold_cost = TrueCost(hierarchy, k, b.y);
      const long double size = std::max<long double>(
          std::max(warm_cost, cold_cost), CostFloor(hierarchy, k));
      if (std::abs(warm_cost - cold_cost) <= 1e-6 * size) continue;
      differs = true;
      std::printf("%4d  %d  %.9Lg  %.9Lg  %.2Le  %.2e %.2e\n", tick,
                  controller.stack().priority_level(k), warm_cost, cold_cost,
                  warm_cost - cold_cost, a.levels[k].gap, b.levels[k].gap);
    }
    differing += differs;
  });
  std::printf("%d of %d ticks differ; both solves are optimal in %d\n",
              differing, tick, both);
}

}  // namespace poise
