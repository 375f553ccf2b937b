// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/number_field.h"

#include <cmath>

#include "poise/robot/finding.h"
#include "poise/robot/input_error.h"

namespace poise {

namespace {

// Relative tolerance of the bounds: 1 / (1 / x) can differ from x by rounding.
constexpr double kRounding = 1e-12;

}  // namespace

bool IsWithin(const NumberField& field, double number) {
  const double slack = kRounding * std::abs(number);
  return std::isfinite(number) && number >= field.least - slack &&
         number <= field.most + slack;
}

std::string Wanted(const NumberField& field) {
  const std::string unit = field.unit;
  return "must be " + PrintNumber(field.least) + " to " +
         PrintNumber(field.most) + (unit.empty() ? "" : " " + unit);
}

void Check(const std::string& group, const std::vector<NumberField>& fields) {
  for (const NumberField& field : fields) {
    for (int i = 0; i < field.size; ++i) {
      const double value = field.inverse ? 1 / field.value[i] : field.value[i];
      if (IsWithin(field, value)) continue;
      throw InputError::OfValue(
          (group.empty() ? "" : group + ".") + field.key,
          " is " + PrintNumber(value) + ", " + Wanted(field));
    }
  }
}

}  // namespace poise
