// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/peers/changed_ticks.h"

#include <random>

#include "poise/tests/util/copy_level.h"

namespace poise {
namespace {

// Returns a random number from -0.01 to 0.01. The distributions of the standard
// library differ between platforms.
double DrawChange(std::mt19937* random) {
  return 0.01 * (2.0 * static_cast<double>((*random)()) / 4294967295.0 - 1);
}

void AddChangedLevel(const Hierarchy& from, int k, bool changes_bounds,
                     std::mt19937* random, Hierarchy* to) {
  auto [equalities, inequalities] = CopyLevel(from, k, to);
  for (double& b : equalities.b) b *= 1 + DrawChange(random);
  if (!changes_bounds) return;
  for (int i = 0; i < from.num_inequalities(k); ++i) {
    const double shift = DrawChange(random);
    inequalities.lower[i] += shift;
    inequalities.upper[i] += shift;
  }
}

}  // namespace

RecordedTicks MakeChangedTicks(const Hierarchy& hierarchy,
                               const std::vector<LevelCapacity>& capacity,
                               int num_changed, bool changes_bounds) {
  RecordedTicks recorded{capacity, {hierarchy}};
  std::mt19937 random(1);
  for (int tick = 0; tick < num_changed; ++tick) {
    Hierarchy changed(hierarchy.num_variables(), capacity);
    changed.Clear(hierarchy.num_levels());
    for (int k = 0; k < hierarchy.num_levels(); ++k) {
      AddChangedLevel(hierarchy, k, changes_bounds, &random, &changed);
    }
    recorded.ticks.push_back(std::move(changed));
  }
  return recorded;
}

}  // namespace poise
