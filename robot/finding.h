// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <string_view>

namespace poise {

/// kNote: odd, but means what it says. kWarn: it can be used, but control may
/// fail or lie. kReject: it cannot be read as a robot.
enum class Severity { kNote, kWarn, kReject };

/// What was found in a robot file, each part on one line.
struct Finding {
  Severity severity;
  std::string where;  ///< "joint 'l_knee' <limit>".
  std::string what;   ///< "upper is 'abc'".
  std::string why;    ///< "must be a number".
  int line = 0;       ///< In the file; 0 where it has none.
};

/// A name from a file, for a message: in quotes, without control characters and
/// cut where it is very long.
std::string Quoted(std::string_view name);

/// "FILE:LINE: where: what, why", on one line.
std::string Message(const std::string& file, const Finding& finding);

}  // namespace poise
