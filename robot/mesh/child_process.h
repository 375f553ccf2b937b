// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace poise {

/// The end of a child process.
struct ChildEnd {
  enum class Kind { kNotStarted, kExited, kSignal, kTooSlow };
  Kind kind = Kind::kNotStarted;
  int code = 0;  ///< The exit code, or the number of the signal.
};

/// The bounds on a child process.
struct ChildLimits {
  double seconds;
  std::size_t memory;  ///< Address space, bytes.
  std::size_t output;  ///< Length of each file that it writes, bytes.
};

/// Runs a command in a child process and waits for its end. The command is
/// searched in PATH. Its standard streams are /dev/null. The child process is
/// killed when the time is over. It inherits the open files that are not marked
/// close-on-exec.
ChildEnd RunChild(const std::vector<std::string>& command,
                  const ChildLimits& limits);

}  // namespace poise
