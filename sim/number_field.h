// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

namespace poise {

/// A number of a setting, or `size` consecutive numbers, with its key in a file
/// and its bounds. The bounds are wide: a value beyond them is a typing error,
/// and would overflow, hang or use up the memory.
struct NumberField {
  const char* key;
  double* value;
  double least, most;
  const char* unit = "";  ///< Empty for a number without unit.
  int size = 1;           ///< How many numbers `value` points to.
  bool inverse = false;  ///< The file has 1 / value, as a rate for a time step.
};

/// Returns whether a number of a file is within the field's bounds. NaN is not.
bool IsWithin(const NumberField& field, double number);

/// Returns the end of an error message: "must be 0 to 10 m".
std::string Wanted(const NumberField& field);

/// Throws InputError("GROUP.KEY is VALUE, must be ...") about the first field
/// that is out of its bounds.
void Check(const std::string& group, const std::vector<NumberField>& fields);

}  // namespace poise
