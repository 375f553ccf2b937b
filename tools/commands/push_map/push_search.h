// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>
#include <optional>

namespace poise {

/// Two neighboring impulses: the largest that is recovered from, as far as
/// bisection can tell, and the next one, that is not.
struct ImpulseBracket {
  double recovered;  ///< N s; 0 if none was.
  double failed;     ///< N s; infinite if every one tried was recovered from.
};

/// Looks for the largest impulse that is recovered from, among the multiples of
/// `step`: doubles or halves the distance from `guess` until it lies between
/// two, then bisects. It is the largest only if recovery from an impulse means
/// recovery from all smaller ones; near the edge that need not be so.
///
/// @param recovers  tries an impulse, N s; nothing: the search is given up.
/// @param guess     where to begin, N s; any number.
/// @param step      of impulses, N s, positive.
/// @param most      where to stop looking for a failure, N s.
///
/// Returns nothing if a trial did. Tries no impulse twice, and the same ones if
/// called again.
std::optional<ImpulseBracket> FindLargestImpulse(
    const std::function<std::optional<bool>(double)>& recovers, double guess,
    double step, double most);

}  // namespace poise
