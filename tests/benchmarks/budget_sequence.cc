// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/benchmarks/budget_sequence.h"

#include <time.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "poise/hqp/solver.h"
#include "poise/sim/quantile.h"
#include "poise/tests/benchmarks/gap_pairs.h"
#include "poise/tools/commands/hqp/hqp_file.h"

namespace poise {
namespace {

// The robot is simulated for so many ticks before the solvers solve them. A
// solver's data then stay in the cache from tick to tick.
constexpr int kTicksAtOnce = 200;
constexpr int kMomentum = 4;  // Priority level.

double ThreadMicroseconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) +
         1e-3 * static_cast<double>(now.tv_nsec);
}

struct Tick {
  Hierarchy hierarchy;
  std::vector<int> priority;  // By level of the hierarchy.
};

class Comparison {
 public:
  Comparison(std::string name, const BudgetOptions& options)
      : options_(options) {
    result_.name = std::move(name);
  }

  void Add(const Controller& controller) {
    const Stack& stack = controller.stack();
    if (solvers_[0].empty()) MakeSolvers(controller);
    Tick tick{controller.hierarchy(), {}};
    for (int k = 0; k < tick.hierarchy.num_levels(); ++k) {
      tick.priority.push_back(stack.priority_level(k));
    }
    ticks_.push_back(std::move(tick));
    if (static_cast<int>(ticks_.size()) == kTicksAtOnce) Solve();
  }

  BudgetResult Finish() {
    Solve();
    return std::move(result_);
  }

 private:
  void MakeSolvers(const Controller& controller) {
    capacity_ = controller.stack().capacity();
    for (const int limited : {0, 1}) {
      for (int repeat = 0; repeat < options_.repeats; ++repeat) {
        solvers_[limited].push_back(
            MakeSolver(controller, limited * options_.budget_us));
      }
    }
    cold_ = MakeSolver(controller, options_.budget_us);
  }

  std::unique_ptr<Solver> MakeSolver(const Controller& controller,
                                     double budget_us) const {
    auto solver = std::make_unique<Solver>(
        controller.hierarchy().num_variables(), capacity_,
        controller.stack().max_leading_rows());
    solver->finds_nullity = false;
    solver->max_modelled_seconds = 1e-6 * budget_us;
    return solver;
  }

  void Solve() {
    if (ticks_.empty()) return;
    std::vector<Solution> answers[2];
    for (const int limited : {0, 1}) {
      answers[limited].assign(
          ticks_.size(),
          Solution(ticks_[0].hierarchy.num_variables(), capacity_));
      SolveWith(limited, &answers[limited]);
    }
    for (size_t i = 0; i < ticks_.size(); ++i) {
      Count(ticks_[i], answers[0][i], answers[1][i]);
    }
    ticks_.clear();
  }

  void SolveWith(int limited, std::vector<Solution>* answers) {
    std::vector<double> fastest(ticks_.size(), 1e300);
    for (const std::unique_ptr<Solver>& solver : solvers_[limited]) {
      for (size_t i = 0; i < ticks_.size(); ++i) {
        hot_ = ticks_[i].hierarchy;
        const double start = ThreadMicroseconds();
        (void)solver->Solve(*hot_, &(*answers)[i]);
        fastest[i] = std::min(fastest[i], ThreadMicroseconds() - start);
        if (solver != solvers_[limited][0]) continue;
        result_.modelled[limited].push_back(1e6 * solver->modelled_seconds());
      }
    }
    std::vector<double>& all = result_.measured[limited];
    all.insert(all.end(), fastest.begin(), fastest.end());
  }

  void Count(const Tick& tick, const Solution& full, const Solution& limited) {
    const bool is_first = result_.ticks++ == 0;
    result_.unsolved += full.status != Status::kOptimal;
    CountGap(tick, full);
    if (limited.status == Status::kOptimal) {
      run_ = 0;
      return;
    }
    ++result_.cut;
    result_.cut_only_warm += IsSolvedCold(tick);
    result_.longest_cut = std::max(result_.longest_cut, ++run_);
    const int lost =
        tick.priority.empty() ? 0 : tick.priority[limited.failed_level];
    result_.lost_leading += !is_first && lost < kMomentum;
    result_.lost_momentum += !is_first && lost <= kMomentum;
    for (size_t k = 0; k < tick.priority.size(); ++k) {
      if (tick.priority[k] > BudgetResult::kLevels) continue;
      const auto level = static_cast<int>(k);
      const long double cost = TrueCost(tick.hierarchy, level, full.y);
      const long double excess =
          TrueCost(tick.hierarchy, level, limited.y) - cost;
      result_.excess[tick.priority[k] - 1].push_back(
          static_cast<double>(excess / Size(tick, level, cost)));
    }
  }

  bool IsSolvedCold(const Tick& tick) {
    Solution solution(tick.hierarchy.num_variables(), capacity_);
    cold_->Forget();
    return cold_->Solve(tick.hierarchy, &solution) == Status::kOptimal;
  }

  void CountGap(const Tick& tick, const Solution& full) {
    result_.gap.push_back(full.certificate.relative_gap);
    double largest = 0;
    for (int k = 0; k < CertifiedLevels(tick.hierarchy, full); ++k) {
      const long double cost = TrueCost(tick.hierarchy, k, full.y);
      largest = std::max(largest, static_cast<double>(full.levels[k].gap /
                                                      Size(tick, k, cost)));
    }
    result_.gap_above_floor.push_back(largest);
  }

  static long double Size(const Tick& tick, int level, long double cost) {
    return std::max<long double>(cost, CostFloor(tick.hierarchy, level));
  }

  BudgetOptions options_;
  BudgetResult result_;
  std::vector<LevelCapacity> capacity_;
  std::array<std::vector<std::unique_ptr<Solver>>, 2> solvers_;
  std::unique_ptr<Solver> cold_;  // With the budget.
  std::vector<Tick> ticks_;
  /// A copy of the tick's hierarchy. Its rows are in the cache, as in a control
  /// loop, where Stack has just written them.
  std::optional<Hierarchy> hot_;
  int run_ = 0;  // Ticks in a row that were cut off.
};

// Prints a cell of quantiles, separated by commas.
void PrintQuantiles(const char* format, std::vector<double>* values,
                    const std::vector<double>& fractions) {
  std::printf(" |");
  if (values->empty()) std::printf(" -");
  for (size_t i = 0; !values->empty() && i < fractions.size(); ++i) {
    std::printf(i == 0 ? " " : ", ");
    std::printf(format, Quantile(values, fractions[i]));
  }
}

void PrintCounts(const std::vector<BudgetResult>& results) {
  std::printf(
      "| sequence | ticks; not optimal without a budget | cut off; of "
      "them solved cold | longest run | levels 1 to 3 lost | momentum lost |\n"
      "| --- | --- | --- | --- | --- | --- |\n");
  for (const BudgetResult& result : results) {
    std::printf("| %s | %d; %d | %d; %d | %d | %d | %d |\n",
                result.name.c_str(), result.ticks, result.unsolved, result.cut,
                result.cut_only_warm, result.longest_cut, result.lost_leading,
                result.lost_momentum);
  }
}

void PrintTimes(std::vector<BudgetResult>* results) {
  std::printf(
      "\nMedian, 99 %% and worst, us:\n\n"
      "| sequence | modelled, without | worst/median | modelled, with | "
      "measured, without | measured, with |\n"
      "| --- | --- | --- | --- | --- | --- |\n");
  for (BudgetResult& result : *results) {
    std::printf("| %s", result.name.c_str());
    PrintQuantiles("%.0f", &result.modelled[0], {0.5, 0.99, 1});
    std::printf(" | %.1f", Quantile(&result.modelled[0], 1) /
                               Quantile(&result.modelled[0], 0.5));
    PrintQuantiles("%.0f", &result.modelled[1], {0.5, 0.99, 1});
    PrintQuantiles("%.0f", &result.measured[0], {0.5, 0.99, 1});
    PrintQuantiles("%.0f", &result.measured[1], {0.5, 0.99, 1});
    std::printf(" |\n");
  }
}

void PrintExcess(std::vector<BudgetResult>* results) {
  std::printf(
      "\nExcess of the cost in the ticks that are cut off, median and worst, "
      "relative:\n\n"
      "| sequence | level 1 | level 2 | level 3 | level 4 | level 5 |\n"
      "| --- | --- | --- | --- | --- | --- |\n");
  for (BudgetResult& result : *results) {
    if (result.cut == 0) continue;
    std::printf("| %s", result.name.c_str());
    for (std::vector<double>& level : result.excess) {
      PrintQuantiles("%.0e", &level, {0.5, 1});
    }
    std::printf(" |\n");
  }
}

void PrintGaps(std::vector<BudgetResult>* results) {
  std::printf(
      "\nGap without a budget, largest of all levels; median, 99.9 %% and "
      "worst:\n\n"
      "| sequence | relative to cost | ticks above 1e-6 | relative to "
      "max(cost, floor) |\n"
      "| --- | --- | --- | --- |\n");
  for (BudgetResult& result : *results) {
    std::printf("| %s", result.name.c_str());
    PrintQuantiles("%.0e", &result.gap, {0.5, 0.999, 1});
    const auto above = std::count_if(result.gap.begin(), result.gap.end(),
                                     [](double gap) { return !(gap <= 1e-6); });
    std::printf(" | %d", static_cast<int>(above));
    PrintQuantiles("%.0e", &result.gap_above_floor, {0.5, 0.999, 1});
    std::printf(" |\n");
  }
}

}  // namespace

BudgetResult CompareBudget(const BudgetSequence& sequence,
                           const BudgetOptions& options) {
  Comparison comparison(sequence.name, options);
  VisitTicks(sequence.conditions,
             [&](const Controller& controller) { comparison.Add(controller); });
  return comparison.Finish();
}

void PrintTables(std::vector<BudgetResult> results) {
  PrintCounts(results);
  PrintTimes(&results);
  PrintExcess(&results);
  PrintGaps(&results);
}

}  // namespace poise
