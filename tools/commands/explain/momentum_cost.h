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
  std::string kind;  ///< Of its rows; empty if the run does not describe them.
  double from = 0;   ///< When it first did, s.
  double cost = 0;   ///< Momentum that was lost by it, N s.
  /// The phrases of its rows and what each cost, largest first.
  std::vector<std::pair<std::string, double>> rows;
};

/// Shares out lost momentum among the constraints that caused the loss.
///
/// In each tick the loss is the force F by which the momentum task misses its
/// target. Its causes are the active constraints that a conflict of the episode
/// has named; where the log has no conflict, all active ones. Row i causes
///     F dt mu_i r_i / (sum_j mu_j r_j),
/// mu_i the multiplier in the log, and r_i the relief that a slightly wider limit
/// of this kind gives: 1 cm of sole, 0.05 of friction, 10 % of torque, 1.6 rad/s2
/// of a joint at its stop.
/// The products are the fall of the momentum task's cost by that relief.
///
/// What is active after F has grown beyond the robot's weight is a consequence
/// of the fall, and is not counted. Losses more than 0.5 s apart are separate
/// episodes; the last one counts.
class MomentumCost {
 public:
  /// Takes in a tick of the log.
  /// @param conflict  of this tick, names and levels; empty if there is none.
  /// @param load      normal force on all feet, N; NaN if unknown.
  void Look(double time, double dt, const RowPhrases& phrases,
            const std::vector<std::pair<std::string, double>>& active,
            const std::vector<std::pair<std::string, double>>& lost,
            const std::vector<std::pair<std::string, double>>& conflict,
            double load);

  /// Most expensive first.
  std::vector<MomentumCause> Causes() const;

  bool has_loss() const { return peak_ > 0; }
  double from() const { return from_; }      ///< Of the loss, s.
  double peak() const { return peak_; }      ///< The largest loss, N.
  double at() const { return at_; }          ///< When it was largest, s.
  double cost() const { return cost_; }      ///< Momentum lost, N s.
  bool is_lost() const { return is_lost_; }  ///< F exceeded the weight.
  double lost_at() const { return lost_at_; }

 private:
  struct Charge {
    std::string task, kind;
    double from = 0, cost = 0;
  };
  using Weights = std::vector<std::pair<std::string, double>>;

  Weights Blame(const RowPhrases& phrases, const Weights& active) const;
  void Begin(double time);

  std::map<std::string, Charge> charges_;  // By phrase.
  std::set<std::string> conflicting_;  // Limits in conflicts of the episode.
  double load_sum_ = 0;
  int loads_ = 0;
  double from_ = 0, peak_ = 0, at_ = 0, cost_ = 0, last_ = 0, lost_at_ = 0;
  bool is_lost_ = false;
};

}  // namespace poise
