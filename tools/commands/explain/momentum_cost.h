// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "poise/tools/commands/explain/row_phrases.h"

namespace poise {

/// A task whose constraints kept the momentum from its target.
struct MomentumCause {
  std::string task;
  std::string kind;  ///< Kind of its rows; empty if not described.
  double from = 0;   ///< Time of its first loss, s.
  double cost = 0;   ///< Momentum lost because of it, N s.
  /// The phrases of its rows and the cost of each, N s, largest first.
  std::vector<std::pair<std::string, double>> rows;
};

/// Divides the lost momentum among the constraints that caused the loss.
///
/// The loss of a tick is the force F by which the momentum task misses its
/// target. Its causes are the active constraints that a conflict of the episode
/// has named. If the log has no conflict, its causes are all active
/// constraints. Row i causes the share
///     F dt mu_i r_i / (sum_j mu_j r_j).
/// Here mu_i is the multiplier in the log. The relief r_i is the amount by
/// which the limit is widened: 1 cm of sole, 0.05 of friction, 10 % of torque,
/// or 1.6 rad/s2 of a joint at its limit. The product mu_i r_i is the decrease
/// of the momentum task's cost that the relief gives.
///
/// Once F exceeds the robot's weight, active constraints are a consequence of
/// the fall and do not count. Losses more than 0.5 s apart are separate
/// episodes. Only the last episode counts. A loss without an active constraint
/// and without a conflict does not begin an episode, because the solver was cut
/// off there.
class MomentumCost {
 public:
  /// Adds a tick of the log.
  /// @param active    active rows with their multipliers.
  /// @param lost      task rows with their residuals.
  /// @param conflict  rows with their levels; empty if there is no conflict.
  /// @param load      normal force on all feet, N; NaN if unknown.
  void Look(double time, double dt, const RowPhrases& phrases,
            const std::vector<std::pair<std::string, double>>& active,
            const std::vector<std::pair<std::string, double>>& lost,
            const std::vector<std::pair<std::string, double>>& conflict,
            double load);

  /// Returns the causes, the largest cost first.
  std::vector<MomentumCause> Causes() const;

  bool has_loss() const { return peak_ > 0; }
  double from() const { return from_; }  ///< Start of the loss, s.
  double peak() const { return peak_; }  ///< Largest loss, N.
  double at() const { return at_; }      ///< Time of peak(), s.
  double cost() const { return cost_; }  ///< Lost momentum, N s.
  /// True if F exceeded the weight; lost_at() is the time of this tick, s.
  bool is_lost() const { return is_lost_; }
  double lost_at() const { return lost_at_; }

 private:
  struct Charge {
    std::string task, kind;
    double from = 0, cost = 0;
  };
  using Weights = std::vector<std::pair<std::string, double>>;

  Weights Blame(const RowPhrases& phrases, const Weights& active) const;
  void Begin(double time);

  std::map<std::string, Charge> charges_;  // The key is a phrase.
  std::set<std::string> conflicting_;      // Rows of this episode.
  double load_sum_ = 0;
  int loads_ = 0;
  double from_ = 0, peak_ = 0, at_ = 0, cost_ = 0, last_ = 0, lost_at_ = 0;
  bool is_lost_ = false;
};

}  // namespace poise
