// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// The value of a joint in a profile, rad or m, and its line in the file.
struct JointValue {
  double value;
  int line;
};

}  // namespace poise
