// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

namespace poise {

/// A number of a setting, or three of them: under which key a file has it, and
/// what it may be. The bounds are wide; what lies beyond is a slip, and would
/// overflow, hang or eat the memory.
struct NumberField {
  const char* key;
  double* value;
  double least, most;
  const char* unit = "";  ///< Empty: it has none.
  int size = 1;           ///< From `value` on.
  bool inverse = false;   ///< A file has 1 / value: a rate for a step.
};

/// Whether a number, as a file has it, is within a field's bounds; NaN is not.
bool IsWithin(const NumberField& field, double number);

/// "must be 0 to 10 m".
std::string Wanted(const NumberField& field);

/// Throws InputError("GROUP.KEY is VALUE, must be ...") about the first that is
/// out of its bounds.
void Check(const std::string& group, const std::vector<NumberField>& fields);

}  // namespace poise
