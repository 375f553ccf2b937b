// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/hqp/fast/budget.h"
#include "poise/hqp/fast/removal_limits.h"
#include "poise/hqp/fast/row_numbers.h"
#include "poise/hqp/fast/working_set_problem.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {

/// Follows the optimum from the data of the last solve to the data of this
/// solve: a parametric active-set method (Ferreau, Bock, Diehl, An online
/// active set strategy to overcome the limitations of explicit MPC, 2008) for a
/// hierarchy.
///
/// At the start of the path, time 0, targets and bounds are shifted, so that
/// the last y, working set and multipliers are optimal. The shift decreases
/// linearly and is zero at time 1. Until the working set changes, y and all
/// multipliers are linear in time, and their end is the optimum of the working
/// set without a shift. A row is added to the working set when y reaches its
/// bound, and removed when its multiplier becomes negative. The multipliers of
/// a row on all levels are one number, see infinitesimals.h. If the optimum
/// changes little, so does the working set.
///
/// Any working set can start the rest of a path from y if its multipliers are
/// not negative: the bounds of its rows are shifted to their values at y, and
/// the targets so that a row that is removed from it has the multiplier zero.
/// So rows can be removed together, also before their multipliers are zero, and
/// rows can be added, with the multiplier zero, before y reaches their bound.
/// This makes a path shorter. Where many rows block at the same time, only
/// RemovalLimits, the limit of iterations and that of alternations exclude a
/// cycle.
///
/// Nothing allocates after construction.
class ParametricSearch {
 public:
  using Sides = std::vector<std::vector<Side>>;

  ParametricSearch(int num_variables,
                   const std::vector<LevelCapacity>& capacity);

  /// Takes the multipliers of a solution, for the start of the next path.
  void Remember(const WorkingSetProblem& problem, const Sides& side);

  /// Forgets the last solution. Until the next Remember(), there is no path.
  void Forget() {
    is_known_ = is_paused_ = is_near_known_ = skips_near_ = false;
    predicts_flip_ = false;
    flipped_ = {};
  }
  bool is_known() const { return is_known_; }

  /// Begins a path at y, or continues the last one from there if it was paused.
  void Begin(const std::vector<double>& y) {
    y_ = y;
    is_continued_ = is_paused_;
    if (!is_paused_) flipped_ = {};
    is_paused_ = false;
  }
  /// Interrupts a path. Until Begin(), Resume() replaces a working set by
  /// `side`. A row that has been added or removed has no multiplier then.
  void Pause(const Sides& side);
  bool is_paused() const { return is_paused_; }
  void Resume(Sides* side) const {
    if (is_paused_) *side = side_;
  }

  /// Returns the point that the path has reached.
  const std::vector<double>& y() const { return y_; }
  std::vector<double>* mutable_y() { return &y_; }

  /// Follows the path, from the working set `side`, for which `problem` is
  /// solved. Returns whether the optimum has been reached: it is y(), and the
  /// solution of `problem`. If not, the budget, or `limit` iterations of it,
  /// did not suffice, or the path was given up, because rows were added and
  /// removed in turn. `problem` is then not solved for the last change of
  /// `side`, or for its first levels only if this iteration was interrupted.
  /// pre: is_known().
  [[nodiscard]] bool Follow(const Hierarchy& hierarchy, int limit,
                            Budget* budget, WorkingSetProblem* problem,
                            Sides* side);

  /// How MeetLevelsBeforeLast() has ended.
  enum class Meeting { kMet, kPostponed, kCutOff };

  /// Solves the leading levels of `problem` for the working set `side`, as
  /// WorkingSetProblem::Start() does with y(), and stores y() in `answer`: it
  /// remains if the path is cut off. Then moves y() to a point that meets all
  /// leading levels but the last, and stores it in `answer` if it is better.
  ///
  /// This point is the optimum of these levels and of `side` that is closest to
  /// y(). If it violates a bound, this moves no further and returns kPostponed:
  /// most paths end soon. For a path that is continued, the point is instead an
  /// optimum near y(), found from the working set of the last search for one,
  /// because its `side` is far from y(). The multipliers of `side` are not
  /// checked.
  ///
  /// Returns kMet if the point has been reached. Also returns kMet, and moves
  /// no further, if there are fewer than two leading levels, or if such a
  /// search took all of the last solve's budget. Returns kCutOff if the budget,
  /// or `limit` iterations of it, did not suffice. Then the path is paused,
  /// `side` is the working set of these levels, and `answer` meets the first
  /// levels only.
  [[nodiscard]] Meeting MeetLevelsBeforeLast(const Hierarchy& hierarchy,
                                             int limit, Budget* budget,
                                             WorkingSetProblem* problem,
                                             Sides* side,
                                             std::vector<double>* answer);

  /// Pauses the path after Follow() and moves y() to an optimum of all leading
  /// levels but the last near it, found from `side`. Stores y() in `answer` if
  /// it is better. Then `side` is the working set of these levels. Returns
  /// whether the point has been reached: if not, the budget, or `limit`
  /// iterations of it, did not suffice, and `answer` stays.
  bool PauseAtLevelsBeforeLast(const Hierarchy& hierarchy, int limit,
                               Budget* budget, WorkingSetProblem* problem,
                               Sides* side, std::vector<double>* answer);

 private:
  struct Blocking {
    RowIndex row;
    Side side = Side::kNone;  ///< kNone: no row blocks.
    double time = 1;
    /// Violation at the end of the path, divided by the sum of absolute
    /// entries.
    double excess = 0;
  };
  /// The last change of the working set.
  struct Change {
    RowIndex added;  ///< No row if a row was removed.
    RowIndex removed;
    Side removed_side = Side::kNone;
    bool is_exchange = false;  ///< A row has replaced another one.
    bool is_flip = false;      ///< Rows have been moved to their other bound.
    bool may_flip = false;     ///< MayFlip() when `removed` was removed.
  };
  /// The last iterations. A path begins as after a long run of additions.
  struct Run {
    /// After so many iterations in a row that all added, or all removed, rows,
    /// the path looks ahead. With 3 and 5, ticks of some robots take longer
    /// (docs/notebook/2026-11-28-look-ahead.md).
    static constexpr int kLong = 4;

    bool adds = true;  ///< Whether the last iteration added rows.
    /// Last iterations that all changed rows in this direction.
    int length = kLong;
    /// Last iterations that each changed the direction, without those that
    /// flipped rows.
    int alternations = 0;
    int flips = 0;  ///< Last iterations that each flipped rows.
    void Count(bool is_addition) {
      const bool goes_on = is_addition == adds;
      length = goes_on ? length + 1 : 1;
      alternations = goes_on ? 0 : alternations + 1;
      adds = is_addition;
      flips = 0;
    }
    /// An exchange adds and removes a row, so it counts as a change of the
    /// direction. A flip has no direction.
    void Count(const Change& change) {
      if (change.is_flip) {
        ++flips;
        length = 0;
      } else {
        Count(change.is_exchange ? !adds : change.added.level >= 0);
      }
    }
  };

  void TakeWorkingSet(const Sides& side);
  bool FindNearest(const Hierarchy& hierarchy, int limit, Budget* budget,
                   WorkingSetProblem* problem, Sides* side);
  bool RemoveNegative(const WorkingSetProblem& problem, int size,
                      const Change& last, Sides* side);
  bool RemoveVanished(const WorkingSetProblem& problem, int size, Change* last,
                      Sides* side);
  bool Step(const Hierarchy& hierarchy, WorkingSetProblem* problem,
            Change* last, Sides* side);
  RowIndex Exchange(const Hierarchy& hierarchy, const Blocking& added, int size,
                    const Change& last, const Sides& side,
                    WorkingSetProblem* problem);
  const double* FindFactors(const Hierarchy& hierarchy, const Blocking& added,
                            const Sides& side,
                            WorkingSetProblem* problem) const;
  void LookAhead(const Hierarchy& hierarchy, const WorkingSetProblem& problem,
                 const Run& run, Change* last, Sides* side);
  double Noise(const WorkingSetProblem& problem) const;
  Blocking FindTime(const Hierarchy& hierarchy,
                    const WorkingSetProblem& problem, RowIndex row,
                    double end_value, double noise, const Change& last) const;
  Blocking FindBlocking(const Hierarchy& hierarchy,
                        const WorkingSetProblem& problem, int num_levels,
                        const Change& last, const Sides& side);
  bool AddAhead(const Hierarchy& hierarchy, const WorkingSetProblem& problem,
                int num_levels, const Change& last, bool again, Sides* side);
  bool RemoveAhead(const WorkingSetProblem& problem, int size,
                   const Change& last, Sides* side);
  bool FlipAhead(const Hierarchy& hierarchy, const WorkingSetProblem& problem,
                 int size, const Change& last, Sides* side);
  bool MayFlip(const Hierarchy& hierarchy, RowIndex row) const;
  Change Flip(RowIndex row, Sides* side);
  RowIndex FindRemoval(const WorkingSetProblem& problem, int size,
                       const Change& last, const Sides& side);
  bool MayRemove(const WorkingSetProblem& problem, int size, const Change& last,
                 const Sides& side, int a);
  static bool IsNegativeAtEnd(const WorkingSetProblem& problem, int size,
                              Side side, int a);
  const double* EndMultiplier(const WorkingSetProblem& problem, int size,
                              const Sides& side, int a);
  void Advance(const WorkingSetProblem& problem, int size, const Sides& side);
  void StepTo(const std::vector<double>& y, double time);
  Change Remove(RowIndex row, Sides* side);
  Change Add(const Blocking& blocking, Sides* side);

  int n_;
  bool is_known_ = false, is_paused_ = false, is_continued_ = false;
  std::vector<double> y_;
  /// Multipliers at the time that has been reached. Rows beyond num_variables
  /// count with the multiplier 0.
  RowNumbers start_;
  Sides side_;  ///< Working set of start_.
  /// The working set of the last search for an optimum of the levels before the
  /// last. It stays known after an optimum of all levels.
  Sides near_side_;
  bool is_near_known_ = false;
  /// The next MeetLevelsBeforeLast() makes no move. Each search for the nearest
  /// point sets this, and Follow() clears it.
  bool skips_near_ = false;
  std::vector<double> center_;
  std::vector<double> end_, time_, removal_time_;  ///< Infinitesimals.
  std::vector<double> scratch_, end_value_;
  RemovalLimits removals_;
  /// Whether rows are flipped instead of removed, also in later solves: a row
  /// that could be flipped was removed and went to its other bound, and no flip
  /// has been wrong since.
  bool predicts_flip_ = false;
  RowIndex flipped_;  ///< The row that the last Step() has flipped.
};

/// Removes rows from a working set whose bound is infinite. Adds rows with
/// equal bounds, which are always in the working set.
void FitToBounds(const Hierarchy& hierarchy, ParametricSearch::Sides* side);

}  // namespace poise
