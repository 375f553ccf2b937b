// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/child_process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

namespace poise {
namespace {

// The exit code of the child process if the command cannot be started.
constexpr int kNotFound = 127;

void Limit(decltype(RLIMIT_AS) resource, rlim_t most) {
  const rlimit limit{most, most};
  setrlimit(resource, &limit);
}

// Replaces the child process by the command. Between fork() and exec(), only
// functions that are safe in a signal handler are called.
[[noreturn]] void Become(char* const* argv, const ChildLimits& limits) {
  setpgid(0, 0);  // Its own group, so that its children end with it.
  const int null = open("/dev/null", O_RDWR);
  for (const int stream : {0, 1, 2}) dup2(null, stream);
  Limit(RLIMIT_AS, limits.memory);
  Limit(RLIMIT_FSIZE, limits.output);
  Limit(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(limits.seconds)) + 1);
  Limit(RLIMIT_CORE, 0);
  execvp(argv[0], argv);
  _exit(kNotFound);
}

ChildEnd Describe(int status) {
  if (WIFSIGNALED(status)) {
    return {ChildEnd::Kind::kSignal, WTERMSIG(status)};
  }
  const int code = WEXITSTATUS(status);
  return code == kNotFound ? ChildEnd{}
                           : ChildEnd{ChildEnd::Kind::kExited, code};
}

}  // namespace

ChildEnd RunChild(const std::vector<std::string>& command,
                  const ChildLimits& limits) {
  using Clock = std::chrono::steady_clock;
  std::vector<char*> argv;
  for (const std::string& word : command) {
    argv.push_back(const_cast<char*>(word.c_str()));
  }
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) return {};
  if (child == 0) Become(argv.data(), limits);
  setpgid(child, child);  // Whichever process is first.
  const auto deadline = Clock::now() + std::chrono::duration<double>(
                                           std::max(0.0, limits.seconds));
  int status = 0;
  for (;;) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return Describe(status);
    if (ended < 0 && errno != EINTR) return {};
    if (Clock::now() > deadline) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  kill(-child, SIGKILL);
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return {ChildEnd::Kind::kTooSlow, 0};
}

}  // namespace poise
