// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/interruption.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstring>

namespace poise {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM};

// Signal handlers may use only atomic variables, and call only functions that
// are safe in them.
std::atomic<bool> g_is_interrupted = false;
char g_line[80];

// Prints the line, and ends the program as the signal does without a handler,
// so that a shell also stops its loop.
void SayAndEnd(int signal) {
  const ssize_t written = write(STDERR_FILENO, g_line, std::strlen(g_line));
  (void)written;
  std::signal(signal, SIG_DFL);
  (void)std::raise(signal);
}

void Remember(int signal) {
  g_is_interrupted = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void SayIfInterrupted(const std::string& name) {
  std::snprintf(g_line, sizeof g_line, "\n%s: interrupted\n", name.c_str());
  for (const int signal : kSignals) {
    if (std::signal(signal, SayAndEnd) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

void CatchInterruption() {
  g_is_interrupted = false;
  for (const int signal : kSignals) std::signal(signal, Remember);
}

bool IsInterrupted() { return g_is_interrupted; }

}  // namespace poise
