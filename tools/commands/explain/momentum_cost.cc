// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/momentum_cost.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace poise {
namespace {

constexpr double kSmallLoss = 0.5;   // N. Smaller losses are ignored.
constexpr double kEpisodeGap = 0.5;  // s, see MomentumCost.
constexpr int kEnoughLoads = 20;     // Ticks for a mean load of one weight.

// Returns by how much a limit of this kind is widened in the unit of its row,
// see MomentumCost. The unit of force rows is a quarter of the weight, and a
// foot carries two such units. So 1 cm of sole is 0.02 of a row, and 0.05 of
// friction is 0.1. The row of a joint limit is an acceleration divided by
// omega^2 = 1600 1/s2, so 1.6 rad/s2 is 0.001 rad.
double Relief(const std::string& kind) {
  constexpr std::pair<std::string_view, double> kReliefs[] = {
      {"cop_limit", 0.02},   {"friction_limit", 0.1},
      {"yaw_limit", 0.02},   {"normal_force_limit", 0.1},
      {"torque_limit", 0.1}, {"joint_limit", 1e-3}};
  for (const auto& [name, relief] : kReliefs) {
    if (kind == name) return relief;
  }
  return 0.1;
}

// Returns the force by which the momentum task misses its target, N.
double LostForce(const RowPhrases& phrases,
                 const std::vector<std::pair<std::string, double>>& lost) {
  double square = 0;
  for (const auto& [name, amount] : lost) {
    const std::string task = phrases.task(name);
    if (task != "momentum" && task != "linear_momentum") continue;
    // Rows of the angular momentum have another unit and do not count.
    if (phrases.unit(name) != "N") continue;
    square += amount * amount;
  }
  return std::sqrt(square);
}

}  // namespace

void MomentumCost::Begin(double time) {
  charges_.clear();
  conflicting_.clear();
  from_ = at_ = time;
  peak_ = cost_ = 0;
  is_lost_ = false;
}

MomentumCost::Weights MomentumCost::Blame(const RowPhrases& phrases,
                                          const Weights& active) const {
  Weights weights;
  for (const auto& [name, multiplier] : active) {
    if (!conflicting_.empty() && conflicting_.count(name) == 0) continue;
    weights.emplace_back(name,
                         std::abs(multiplier) * Relief(phrases.kind(name)));
  }
  return weights;
}

void MomentumCost::Look(double time, double dt, const RowPhrases& phrases,
                        const Weights& active, const Weights& lost,
                        const Weights& conflict, double load) {
  if (std::isfinite(load)) {
    load_sum_ += load;
    ++loads_;
  }
  const double force = LostForce(phrases, lost);
  if (!(force >= kSmallLoss)) return;
  if (peak_ == 0 || time - last_ > kEpisodeGap) {
    if (active.empty() && conflict.empty()) return;
    Begin(time);
  }
  last_ = time;
  for (const auto& [name, level] : conflict) {
    const auto is_same = [&](const auto& row) { return row.first == name; };
    const bool is_active = std::any_of(active.begin(), active.end(), is_same);
    if (phrases.is_limit(name) || (!phrases.is_described(name) && is_active)) {
      conflicting_.insert(name);
    }
  }
  if (force > peak_) {
    peak_ = force;
    at_ = time;
  }
  if (!is_lost_ && loads_ >= kEnoughLoads && force > load_sum_ / loads_) {
    is_lost_ = true;
    lost_at_ = time;
  }
  if (is_lost_ && !charges_.empty()) return;
  cost_ += force * dt;
  const Weights weights = Blame(phrases, active);
  double sum = 0;
  for (const auto& [name, weight] : weights) sum += weight;
  if (!(sum > 0)) return;
  for (const auto& [name, weight] : weights) {
    const auto [charge, is_new] = charges_.try_emplace(phrases.phrase(name));
    if (is_new) {
      charge->second = {phrases.task(name), phrases.kind(name), time, 0};
    }
    charge->second.cost += force * dt * weight / sum;
  }
}

std::vector<MomentumCause> MomentumCost::Causes() const {
  std::vector<MomentumCause> causes;
  for (const auto& [phrase, charge] : charges_) {
    auto cause = std::find_if(
        causes.begin(), causes.end(),
        [&](const MomentumCause& other) { return other.task == charge.task; });
    if (cause == causes.end()) {
      causes.push_back({charge.task, charge.kind, charge.from, 0, {}});
      cause = causes.end() - 1;
    }
    cause->from = std::min(cause->from, charge.from);
    cause->cost += charge.cost;
    cause->rows.emplace_back(phrase, charge.cost);
  }
  for (MomentumCause& cause : causes) {
    std::stable_sort(
        cause.rows.begin(), cause.rows.end(),
        [](const auto& a, const auto& b) { return a.second > b.second; });
  }
  std::stable_sort(causes.begin(), causes.end(),
                   [](const MomentumCause& a, const MomentumCause& b) {
                     return a.cost > b.cost;
                   });
  return causes;
}

}  // namespace poise
