// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/child_process.h"

#include <gtest/gtest.h>

#include <csignal>

namespace poise {
namespace {

using Kind = ChildEnd::Kind;

// No command of this test needs as much.
constexpr ChildLimits kEnough{100, std::size_t{1} << 30, 1 << 20};

ChildEnd RunShell(const std::string& script, ChildLimits limits = kEnough) {
  return RunChild({"sh", "-c", script}, limits);
}

TEST(RunChild, ReturnsTheExitCode) {
  for (const int code : {0, 1, 42}) {
    const ChildEnd end = RunShell("exit " + std::to_string(code));
    EXPECT_EQ(end.kind, Kind::kExited);
    EXPECT_EQ(end.code, code);
  }
}

TEST(RunChild, ReportsACrash) {
  const ChildEnd end = RunShell("kill -SEGV $$");
  EXPECT_EQ(end.kind, Kind::kSignal);
  EXPECT_EQ(end.code, SIGSEGV);
}

TEST(RunChild, ReportsAMissingCommand) {
  EXPECT_EQ(RunChild({"no-such-command-exists"}, kEnough).kind,
            Kind::kNotStarted);
}

TEST(RunChild, KillsAChildThatIsTooSlow) {
  EXPECT_EQ(RunShell("sleep 1000", {0.05, kEnough.memory, 1}).kind,
            Kind::kTooSlow);
}

// The shell reads a line of a hundred megabytes into a variable.
TEST(RunChild, BoundsTheMemory) {
  const std::string script =
      "x=$(head -c 100000000 /dev/zero | tr '\\0' x) && test -n \"$x\"";
  const ChildEnd end = RunShell(script, {100, 50 << 20, 1});
  EXPECT_FALSE(end.kind == Kind::kExited && end.code == 0);
}

TEST(RunChild, BoundsTheOutput) {
  const std::string file = std::string(std::getenv("TEST_TMPDIR")) + "/out";
  const ChildEnd end =
      RunShell("head -c 100000 /dev/zero > " + file, {100, 1 << 30, 1000});
  EXPECT_FALSE(end.kind == Kind::kExited && end.code == 0);
}

}  // namespace
}  // namespace poise
