// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/child_process.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace poise {
namespace {

using Kind = ChildEnd::Kind;

// No command of this test needs as much.
constexpr ChildLimits kEnough{100, std::size_t{1} << 30, 1 << 20};

std::string Folder() { return std::getenv("TEST_TMPDIR"); }

// Returns whether this process has no child, not even a zombie.
bool HasNoChild() {
  return waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD;
}

// Returns whether a process runs. A zombie does not run.
bool Runs(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  return stat >> number >> name >> state && state != "Z" && state != "X";
}

// Returns whether a process ends. SIGKILL takes a moment to end a process.
bool Ends(pid_t process) {
  constexpr int kTries = 1000;
  for (int i = 0; i < kTries && Runs(process); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return !Runs(process);
}

ChildEnd RunShell(const std::string& script, ChildLimits limits = kEnough) {
  const ChildEnd end = RunChild({"sh", "-c", script}, limits);
  EXPECT_TRUE(HasNoChild());
  return end;
}

// Runs a script that writes the numbers of its processes to `pids`, and expects
// that none of them remains.
ChildEnd RunAndExpectNoneLeft(const std::string& script, int processes,
                              const ChildLimits& limits) {
  const std::string file = Folder() + "/pids";
  std::filesystem::remove(file);
  const ChildEnd end = RunShell("cd " + Folder() + "; " + script, limits);
  std::ifstream pids(file);
  int found = 0;
  for (pid_t pid = 0; pids >> pid; ++found) EXPECT_TRUE(Ends(pid)) << script;
  EXPECT_EQ(found, processes) << script;
  return end;
}

TEST(RunChild, ReturnsTheExitCode) {
  for (const int code : {0, 1, 42, 126, 127, 255}) {
    const ChildEnd end = RunShell("exit " + std::to_string(code));
    EXPECT_EQ(end.kind, Kind::kExited);
    EXPECT_EQ(end.code, code);
  }
}

TEST(RunChild, ReportsACrash) {
  for (const int number : {SIGSEGV, SIGABRT, SIGKILL, SIGTERM}) {
    const ChildEnd end = RunAndExpectNoneLeft(
        "echo $$ > pids; kill -" + std::to_string(number) + " $$", 1, kEnough);
    EXPECT_EQ(end.kind, Kind::kSignal);
    EXPECT_EQ(end.code, number);
  }
}

TEST(RunChild, SaysWhyACommandIsNotStarted) {
  const ChildEnd missing = RunChild({"no-such-command-exists"}, kEnough);
  EXPECT_EQ(missing.kind, Kind::kNotStarted);
  EXPECT_EQ(missing.code, ENOENT);
  const std::string file = Folder() + "/no_program";
  std::ofstream(file) << "";
  const ChildEnd forbidden = RunChild({file}, kEnough);
  EXPECT_EQ(forbidden.kind, Kind::kNotStarted);
  EXPECT_EQ(forbidden.code, EACCES);
  EXPECT_TRUE(HasNoChild());
}

// A hanging process ignores polite signals and has started another process.
TEST(RunChild, KillsAChildThatIsTooSlowAndItsGroup) {
  const ChildEnd end = RunAndExpectNoneLeft(
      "trap '' TERM INT HUP; sleep 1000 & echo $$ $! > pids; "
      "while :; do sleep 1; done",
      2, {0.5, kEnough.memory, kEnough.output});
  EXPECT_EQ(end.kind, Kind::kTooSlow);
}

TEST(RunChild, KillsWhatAChildLeavesBehind) {
  const ChildEnd end = RunAndExpectNoneLeft(
      "sleep 1000 & echo $$ $! > pids; exit 3", 2, kEnough);
  EXPECT_EQ(end.kind, Kind::kExited);
  EXPECT_EQ(end.code, 3);
}

// The shell reads 400 million bytes into a variable, with a bound of 50 MiB.
TEST(RunChild, BoundsTheMemory) {
  const std::string script =
      "echo $$ > pids; x=$(head -c 400000000 /dev/zero | tr '\\0' x); "
      "echo done >> done";
  const ChildEnd end = RunAndExpectNoneLeft(
      script, 1, {100, std::size_t{50} << 20, kEnough.output});
  EXPECT_FALSE(end.kind == Kind::kExited && end.code == 0);
  EXPECT_NE(end.kind, Kind::kTooSlow);
  EXPECT_FALSE(std::filesystem::exists(Folder() + "/done"));
  // Before exec(), the child process is a copy of this one.
  rusage own{}, children{};
  getrusage(RUSAGE_SELF, &own);
  getrusage(RUSAGE_CHILDREN, &children);
  EXPECT_LE(children.ru_maxrss, own.ru_maxrss + (50 << 10));  // KiB.
}

// The child writes for ever. The caller ignores the signal of this bound.
TEST(RunChild, BoundsTheOutput) {
  const std::string file = Folder() + "/endless";
  const auto before = signal(SIGXFSZ, SIG_IGN);
  const ChildEnd end =
      RunAndExpectNoneLeft("echo $$ > pids; exec cat /dev/zero > endless", 1,
                           {100, kEnough.memory, 1000});
  signal(SIGXFSZ, before);
  EXPECT_EQ(end.kind, Kind::kSignal);
  EXPECT_EQ(end.code, SIGXFSZ);
  EXPECT_EQ(std::filesystem::file_size(file), 1000u);
}

TEST(RunChild, BoundsTheTimeOfEndlessOutputToTheStreams) {
  const ChildEnd end = RunAndExpectNoneLeft(
      "echo $$ > pids; exec cat /dev/zero", 1, {0.2, kEnough.memory, 1000});
  EXPECT_EQ(end.kind, Kind::kTooSlow);
}

TEST(RunChild, GivesTheChildEmptyStreams) {
  EXPECT_EQ(RunShell("read line").code, 1);
  RunShell("cd /proc/$$/fd; readlink 0 1 2 | cat > " + Folder() + "/streams");
  std::ifstream streams(Folder() + "/streams");
  for (int stream = 0; stream < 3; ++stream) {
    std::string target;
    streams >> target;
    EXPECT_EQ(target, "/dev/null");
  }
}

// The system discards the end of the child process.
TEST(RunChild, SaysThatTheEndIsUnknownIfSigchldIsIgnored) {
  const auto before = signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(RunShell("exit 3").kind, Kind::kUnknown);
  EXPECT_EQ(RunShell("sleep 1000", {0.1, kEnough.memory, 1}).kind,
            Kind::kTooSlow);
  EXPECT_EQ(RunChild({"no-such-command-exists"}, kEnough).kind,
            Kind::kNotStarted);
  signal(SIGCHLD, before);
  EXPECT_EQ(RunShell("exit 3").code, 3);
}

}  // namespace
}  // namespace poise
