// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

namespace poise {

/// Compares the names of two links or joints at the same place in two limbs.
/// Returns 1 if the names say that the first one is on the left and the second
/// one on the right, -1 if the reverse, and 0 if they do not say it.
///
/// The names say it if they differ only by `left` and `right`, or only by the
/// letters `l` and `r`: `leg_l6` and `leg_r6`, `LL_FAA` and `LR_FAA`, `LAnkle`
/// and `RAnkle`. Names that differ elsewhere are compared by their words:
/// `left` or `right` anywhere, or a single letter `l` or `r` between other
/// characters than letters. Case does not matter.
int CompareSides(const std::string& a, const std::string& b);

/// Returns 1 if the name of a link or joint has a word for a part of a leg,
/// such as `hip`, `knee` or `foot`. Returns -1 for a part of an arm, and 0 if
/// the name has no such word, or words for both. Words end at capitals and at
/// characters that are no letters; `lknee` and `kneepitch` are words for a
/// knee, but `harmony` and `machine` are no words for an arm and a shin.
int LegOrArm(const std::string& name);

}  // namespace poise
