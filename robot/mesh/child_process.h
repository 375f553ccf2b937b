// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace poise {

/// The end of a child process.
struct ChildEnd {
  enum class Kind {
    kNotStarted,  ///< The command could not be started.
    kExited,
    kSignal,
    kTooSlow,
    kUnknown,  ///< The caller ignores SIGCHLD, so the system keeps no end.
  };
  Kind kind = Kind::kNotStarted;
  /// The exit code, the number of the signal, or why the command could not be
  /// started: a value of errno.
  int code = 0;
};

/// The bounds on a child process.
struct ChildLimits {
  double seconds;
  std::size_t memory;  ///< Address space, bytes.
  std::size_t output;  ///< Length of each file that it writes, bytes.
};

/// Runs a command in a child process and waits for its end. The command is
/// searched in PATH. Its standard streams are /dev/null. The child process is
/// killed when the time is over. When the child process has ended, the
/// processes that it started in its group are killed. It inherits the open
/// files that are not marked close-on-exec.
///
/// A child process that writes more than `limits.output` ends with the signal
/// SIGXFSZ.
ChildEnd RunChild(const std::vector<std::string>& command,
                  const ChildLimits& limits);

}  // namespace poise
