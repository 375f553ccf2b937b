// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace poise {

/// Two neighboring impulses: the largest impulse with recovery that bisection
/// finds, and the next one, without recovery.
struct ImpulseBracket {
  double recovered;  ///< N s; 0 if there was no recovery.
  double failed;     ///< N s; infinite if each trial recovered.
};

/// Finds the largest impulse with recovery among the multiples of `step`. The
/// search moves away from `guess` with doubling distance until it has bracketed
/// the impulse. Then it bisects. The result is the largest only if recovery
/// from an impulse implies recovery from all smaller ones. Near the limit this
/// may be false.
///
/// @param recovers  tries an impulse, N s. Returns nothing to abort the search.
/// @param guess     first impulse to try, N s; any number.
/// @param step      difference between successive impulses, N s, positive.
/// @param most      largest impulse to try, N s.
///
/// Returns nothing if a trial aborts the search. Tries no impulse twice. With
/// the same results of `recovers`, another call tries the same impulses.
std::optional<ImpulseBracket> FindLargestImpulse(
    const std::function<std::optional<bool>(double)>& recovers, double guess,
    double step, double most);

/// The result of a scan over impulses, N s.
struct ImpulseScan {
  double recovered = 0;  ///< Largest impulse below the first without recovery.
  double failed = 0;     ///< First impulse without recovery; may be infinite.
  std::vector<double> holes;  ///< Without recovery, below one with recovery.
};

/// Tries each multiple of `step` from `from` to the first impulse without
/// recovery, and 20 % farther. Near the limit, recovery from an impulse does
/// not imply recovery from all smaller ones; a bisection would not see that.
///
/// @param recovers  as for FindLargestImpulse().
/// @param most      largest impulse to try, N s.
///
/// Returns nothing if a trial aborts the scan.
std::optional<ImpulseScan> ScanImpulses(
    const std::function<std::optional<bool>(double)>& recovers, double from,
    double step, double most);

}  // namespace poise
