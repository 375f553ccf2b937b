// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/math/rank.h"

/// Every threshold of the fast solver. All but those for weights are relative
/// to the magnitudes of the terms of a number, so that units do not matter.
/// With eps = 2e-16, a sum of a hundred terms is rounded by up to 2e-14.
///
/// Each value was tested ten times larger and ten times smaller, by the number
/// of failures of //tests:hqp_night. Hierarchies without weights or units have
/// no failure with any of these values. The counts below are of other
/// hierarchies.
namespace poise::tolerances {

/// Search: a slope or a violation below this is zero. It equals kRankTolerance,
/// because a row that depends on the working set to within kRankTolerance has a
/// slope of that size along each step. Such a row must not block the step. Ten
/// times larger or smaller, no count changes.
constexpr double kZeroSlope = kRankTolerance;

/// Search: rounding of an entry of y, relative to WorkingSetProblem::Size().
/// Five times the rounding of a sum of a hundred terms. Ten times larger or
/// smaller, one of 3000 hierarchies with variables of unlike units changes.
constexpr double kSolutionRounding = 1e-13;

/// Search: a multiplier below this is zero. It lies two digits below
/// kRankTolerance: a level that gains a rank of that size when a row is removed
/// can have a multiplier of a hundredth of kRankTolerance on this row. Ten
/// times larger, rows of row_scaling_test are not removed. Ten times smaller,
/// 20 instead of 18 of 3000 hierarchies with rows from 1e-3 to 1e6 fail.
constexpr double kZeroMultiplier = 1e-13;

/// Search: a factor of a combination of rows below this part of the largest
/// one, or in an exchange below this part of the row's length, is zero. A row
/// that is removed for a tiny factor would be far inside its bound at the next
/// optimum. Chosen: 1e-7 and 1e-2 change the worst solves of falls by factors
/// from 0.9 to 1.9 (docs/notebook/2026-11-29-dependent-rows.md).
constexpr double kZeroFactor = 1e-4;

/// Input: a row is zero if its weight times its squared norm is below this. The
/// reciprocal of a number below 1e-308 overflows; this leaves eight digits for
/// factors.
constexpr double kZeroRow = 1e-300;

/// Working set: a row whose bound is beyond this is not kept from the last
/// solve, and is not flipped. At such a large y, the other rows, with terms
/// near 1, lose all 15 digits to rounding. Ten times larger or smaller, no
/// count changes.
constexpr double kInfiniteBound = 1e15;

/// Factorisation: a projection that leaves less than this part of a row's
/// length is repeated. "Twice is enough" (Parlett) holds for this value.
/// Ten times smaller, ZeroCoordinate.IsZeroInRowsThatShareVariables fails.
constexpr double kReorthogonalize = 0.5;

/// Factorisation: least part of a new row that is independent of the others, if
/// the row is to be appended by an update. An update then loses at most three
/// digits; below that the level is factored anew. Also for a combination of
/// rows: the least part of a row that does not depend on them. Also for the
/// diagonal levels: least part of a new row of T/d, and least pivot of T_cc
/// after a row was removed. Chosen: ten times larger or smaller changes one
/// count of 3000 by one, and the time.
constexpr double kIndependentPart = 1e-3;

/// Factorisation: a kept remainder above this is orthogonal to the merged
/// levels to within three digits of rounding, and is not projected again. An
/// update of the merged levels loses as many digits (kIndependentPart). Chosen:
/// a value of 1 projects all of them again, and changes no count.
constexpr double kCleanRemainder = 1e-3;

/// Factorisation: a downdated squared norm that is below this part of its last
/// exact value has lost two digits, and is computed again. Chosen: ten times
/// larger or smaller, no count changes.
constexpr double kDowndate = 0.01;

/// Factorisation: a residual below this is zero, relative to the terms of the
/// residual. Fifty times the rounding of a sum of a hundred terms. Ten times
/// larger, RowScaling.KeepsARowWithASmallMultiplier loses its row, and 79
/// instead of 74 of 3000 hierarchies with variables of unlike units fail.
constexpr double kZeroResidual = 1e-12;

/// Factorisation: a residual below this part of the largest residual of its
/// level is rounding of up to fifty reflections, each of which adds an eps. Ten
/// times larger or smaller, no count changes.
constexpr double kReflectionRounding = 1e-14;

/// Diagonal levels: an entry of a row of unit length below this is rounding.
/// The value is a few eps, because the reflections of these rows have few
/// terms. Ten times smaller, 8 instead of 3 of 5000 hierarchies with weights
/// from 1e-6 to 1e6 fail.
constexpr double kZeroEntry = 1e-15;

/// Diagonal levels: a gradient below this is zero. Five times the rounding of a
/// sum of a hundred terms. Ten times smaller, one of 3000 hierarchies changes.
constexpr double kZeroGradient = 1e-13;

/// Diagonal levels: a sum of rows, of unit length, whose remainder is below
/// this lies in a row space. The value is the rounding of a sum of a hundred
/// terms. One of 24 rows may then be outside by 1.5e-13. Ten times larger or
/// smaller, no count changes.
constexpr double kSameRowSpace = 2e-14;

/// Diagonal levels: squared weights of one level that differ by more than this
/// are orthogonalised together. Rounding of the large-weight variables is
/// multiplied by this ratio, and three digits may be lost. Chosen: ten times
/// larger or smaller, no count changes.
constexpr double kLargeWeightRatio = 1e3;

/// Refinement: rows whose residual is below this need no further pass. Five
/// times the rounding of a sum of a hundred terms. Ten times larger or smaller,
/// no count changes.
constexpr double kRefined = 1e-13;

/// Refinement: weights of a level that cannot be met, if they differ by more
/// than this, need a second pass: the first one gives small-weight rows fewer
/// than nine digits. Chosen: ten times larger or smaller, no count changes.
constexpr double kUnevenWeights = 1e6;

/// Refinement: an entry of y below this, relative to WorkingSetProblem::Size(),
/// may be set to zero. It is rounding of rounding, 5e-3 eps. Ten times larger
/// or smaller, no count changes.
constexpr double kNegligibleEntry = 1e-18;

/// Refinement: the same limit for the entries of one row that y violates. The
/// value is fifty eps: entries are set to zero row by row, and restored if a
/// residual grows. Ten times larger or smaller, no count changes.
constexpr double kNegligibleEntryOfRow = 1e-14;

}  // namespace poise::tolerances
