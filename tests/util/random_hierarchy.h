// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {

/// Options of a random hierarchy. Chances are in percent.
struct RandomHierarchyOptions {
  int max_variables = 12;
  int max_levels = 5;
  int max_equalities = 6;    ///< Per level.
  int max_inequalities = 8;  ///< Per level.

  /// Chance that a row is degenerate: a row of zeros, a row that selects one
  /// variable, or an earlier row, copied, scaled or combined with another. The
  /// earlier row is on the same level or on one above, and compatible or in
  /// conflict.
  int degenerate = 25;

  /// Chance that the bound of a row passes through one common point: many rows
  /// then meet in that point.
  int planted = 30;

  /// Chance that a hierarchy has rows of scales from 1e-3 to 1e6.
  int scaled = 20;

  /// Chance that a hierarchy mixes weights from 1e-decades to 1e+decades.
  int weighted = 0;
  int decades = 4;

  /// Chance that the last levels only select variables.
  int selecting = 50;

  /// Chance that all bounds are zero, as at the degenerate vertex of friction
  /// cones. In most of these hierarchies only y = 0 satisfies the bounds,
  /// whatever the targets.
  int degenerate_vertex = 0;

  /// Chance that a hierarchy has rows of small integers. Most of these rows
  /// meet in a point of integers, about half of which are 0. There nothing is
  /// rounded: dependent rows depend exactly. Where y is 0, nothing shows how
  /// large its rounding error may be.
  int integer = 0;

  /// Chance that each variable has its own unit: columns are scaled by powers
  /// of ten from 1e-3 to 1e6.
  int columns = 0;

  /// Chance that about half of the columns are scaled by 1e-3, as those of
  /// joints of small mass are.
  int small_columns = 0;

  /// Chance that an inequality bounds one variable, as a limit of a joint does.
  int bounds = 0;
};

/// A hierarchy and the capacity of the solver that solves it.
struct HierarchyCase {
  std::vector<LevelCapacity> capacity;
  Hierarchy hierarchy;
};

/// Draws a hierarchy. The same seed gives the same hierarchy on every platform.
/// Numbers are multiples of 0.01, so that files are short. The options
/// `weighted`, `degenerate_vertex`, `integer`, `columns`, `small_columns` and
/// `bounds` consume no random number if they are 0: hierarchies of known seeds
/// do not change. Spans are found if there are `bounds`.
HierarchyCase MakeRandomHierarchy(std::uint64_t seed,
                                  const RandomHierarchyOptions& options = {});

/// Returns the same hierarchy with capacity for the changes of
/// ChangeHierarchy(), and finds its spans.
HierarchyCase WithRoomToChange(const HierarchyCase& drawn);

/// Changes a hierarchy as the next tick may change it. It must have room, see
/// WithRoomToChange(). The seed draws one to three of these changes:
/// - The targets or the bounds of a level move.
/// - Bounds of an inequality are added, removed or made equal.
/// - All bounds of a level become zero.
/// - A row turns, or an inequality is removed.
/// - A row becomes a copy of another row, or nearly, so that its level loses
///   rank.
/// - Two levels swap places, and the last level may be removed.
void ChangeHierarchy(std::uint64_t seed, HierarchyCase* drawn);

/// Returns the size of the terms that add up to the cost of a level at a
/// solution's y. The rounding error of the cost is a multiple of eps times this
/// size.
double CostSize(const Hierarchy& hierarchy, int level,
                const Solution& solution);

}  // namespace poise
