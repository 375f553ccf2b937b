// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

namespace poise {

/// One or three numbers of a setting, with their key in a file and their bounds. The
/// bounds are wide. A value beyond them would overflow, hang or exhaust the memory.
struct NumberField {
  const char* key;
  double* value;
  double least, most;
  const char* unit = "";  ///< Empty: it has none.
  int size = 1;           ///< From `value` on.
  bool inverse = false;   ///< A file has 1 / value: a rate for a step.
};

/// Returns whether a number is within a field's bounds; false for NaN.
bool IsWithin(const NumberField& field, double number);

/// Returns "must be 0 to 10 m".
std::string Wanted(const NumberField& field);

/// Throws InputError("GROUP.KEY is VALUE, must be ...") about the first number out of
/// its bounds.
void Check(const std::string& group, const std::vector<NumberField>& fields);

}  // namespace poise
