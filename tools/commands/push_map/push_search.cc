// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push_map/push_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poise {

std::optional<ImpulseBracket> FindLargestImpulse(
    const std::function<std::optional<bool>(double)>& recovers, double guess,
    double step, double most) {
  // Impulses are counted in steps. The largest recovered one is in [good, bad).
  // Impulse 0 counts as recovered.
  const long end = std::max(1l, std::lround(most / step));
  long good = 0;
  long bad = std::numeric_limits<long>::max();
  long reach = 2;
  long next = std::isfinite(guess)
                  ? std::clamp(std::lround(guess / step), 1l, end)
                  : end;
  while (bad - good > 1) {
    const auto recovered = recovers(static_cast<double>(next) * step);
    if (!recovered) return std::nullopt;
    (*recovered ? good : bad) = next;
    if (good == end) break;
    if (bad == std::numeric_limits<long>::max()) {
      next = std::min(end, good + reach);
    } else if (good == 0) {
      next = std::max(1l, bad - reach);
    } else {
      next = good + (bad - good) / 2;
    }
    reach *= 2;
  }
  return ImpulseBracket{static_cast<double>(good) * step,
                        bad == std::numeric_limits<long>::max()
                            ? std::numeric_limits<double>::infinity()
                            : static_cast<double>(bad) * step};
}

std::optional<ImpulseScan> ScanImpulses(
    const std::function<std::optional<bool>(double)>& recovers, double from,
    double step, double most) {
  constexpr double kBeyond = 1.2;
  constexpr double kRounding = 1e-9;
  ImpulseScan scan;
  scan.failed = std::numeric_limits<double>::infinity();
  double end = most;
  std::vector<double> failures;
  for (long i = std::max(1l, std::lround(from / step));; ++i) {
    const double impulse = static_cast<double>(i) * step;
    if (impulse > end * (1 + kRounding)) break;
    const auto recovered = recovers(impulse);
    if (!recovered) return std::nullopt;
    if (!*recovered) {
      if (failures.empty()) {
        scan.failed = impulse;
        end = std::min(most, kBeyond * impulse);
      }
      failures.push_back(impulse);
    } else if (failures.empty()) {
      scan.recovered = impulse;
    } else {
      scan.holes = failures;
    }
  }
  return scan;
}

}  // namespace poise
