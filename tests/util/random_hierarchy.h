// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {

/// What a random hierarchy is drawn from.
struct RandomHierarchyOptions {
  int max_variables = 12;
  int max_levels = 5;
  int max_equalities = 6;    ///< A level.
  int max_inequalities = 8;  ///< A level.

  /// Chance, in percent, that a row is not drawn afresh but is a row of zeros, a
  /// copy of one before, scaled or combined with another: of its own level or
  /// of one above, met with it or in conflict.
  int degenerate = 25;

  /// Chance that the bound of a row is where a certain y is: many rows then
  /// meet in one point.
  int planted = 30;

  /// Chance that a hierarchy has rows of scales from 1e-3 to 1e6.
  int scaled = 20;

  /// Chance that a hierarchy has weights from 1e-decades to 1e+decades, side by
  /// side.
  int weighted = 0;
  int decades = 4;

  /// Chance that the last levels only select variables.
  int selecting = 50;

  /// Chance that all bounds are zero, as at the degenerate_vertex of friction cones: mostly no
  /// y but zero is left then, whatever is asked for.
  int degenerate_vertex = 0;

  /// Chance that a hierarchy has rows of small whole numbers, most of which meet
  /// in a point of whole numbers, about half of them 0. There nothing is rounded: what
  /// depends on others does so exactly, and where y is 0 nothing tells how large
  /// its rounding may be.
  int integer = 0;

  /// Chance that each variable has a unit of its own: columns are scaled by
  /// powers of ten from 1e-3 to 1e6.
  int columns = 0;
};

/// A hierarchy and the sizes to solve it with.
struct HierarchyCase {
  std::vector<LevelCapacity> capacity;
  Hierarchy hierarchy;
};

/// Draws one; the same from the same seed everywhere. Numbers are whole
/// hundredths, so that files of it are short. What an option of 0 leaves out
/// draws nothing: with it at 0 a seed gives what it gave before there was one.
HierarchyCase MakeRandomHierarchy(std::uint64_t seed,
                                  const RandomHierarchyOptions& options = {});

/// The same hierarchy with room for what ChangeHierarchy() makes of it.
HierarchyCase WithRoomToChange(const HierarchyCase& drawn);

/// Makes of a hierarchy with room to change what may come a tick later: a few
/// of these at once, drawn by the seed. Targets and bounds move; bounds come, go
/// and meet; all of a level's get zero; rows turn, and go; a row gets a copy of
/// another, or nearly, so that its level loses rank; a level takes another's
/// place, or the last one is left out.
void ChangeHierarchy(std::uint64_t seed, HierarchyCase* drawn);

/// What the cost of a level is added up from at a solution's y: its rounding is
/// a multiple of eps of that.
double CostSize(const Hierarchy& hierarchy, int level,
                const Solution& solution);

}  // namespace poise
