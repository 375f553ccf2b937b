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

// A pipe that carries the error of exec(). A successful exec() closes it.
class ErrorPipe {
 public:
  ErrorPipe() {
    if (pipe2(ends_, O_CLOEXEC | O_NONBLOCK) != 0) ends_[0] = ends_[1] = -1;
  }
  ~ErrorPipe() {
    for (const int end : ends_) {
      if (end >= 0) close(end);
    }
  }
  ErrorPipe(const ErrorPipe&) = delete;
  ErrorPipe& operator=(const ErrorPipe&) = delete;

  bool is_open() const { return ends_[0] >= 0; }
  int writer() const { return ends_[1]; }

  // Returns the error that the child process wrote, or 0.
  int Read() const {
    int error = 0;
    const bool is_written =
        read(ends_[0], &error, sizeof error) == ssize_t{sizeof error};
    return is_written ? error : 0;
  }

 private:
  int ends_[2];
};

void Limit(decltype(RLIMIT_AS) resource, rlim_t most) {
  const rlimit limit{most, most};
  setrlimit(resource, &limit);
}

// Replaces the child process by the command. Between fork() and exec(), only
// functions that are safe in a signal handler are called.
[[noreturn]] void Become(char* const* argv, const ChildLimits& limits,
                         int errors) {
  setpgid(0, 0);  // Its own group, so that its children end with it.
  // The standard streams may be closed, and then the pipe has their numbers.
  constexpr int kFirstAboveStreams = 3;
  errors = fcntl(errors, F_DUPFD_CLOEXEC, kFirstAboveStreams);
  const int null = open("/dev/null", O_RDWR);
  for (const int stream : {0, 1, 2}) dup2(null, stream);
  // The caller may ignore these signals, and then its child would, too.
  for (const int signal_number : {SIGXFSZ, SIGXCPU, SIGPIPE, SIGCHLD}) {
    signal(signal_number, SIG_DFL);
  }
  Limit(RLIMIT_AS, limits.memory);
  Limit(RLIMIT_FSIZE, limits.output);
  Limit(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(limits.seconds)) + 1);
  Limit(RLIMIT_CORE, 0);
  execvp(argv[0], argv);
  constexpr int kNotFound = 127;  // As a shell does.
  constexpr int kNotWritten = 126;
  const int error = errno;
  _exit(write(errors, &error, sizeof error) > 0 ? kNotFound : kNotWritten);
}

// Waits until the child process has ended or the time is over. Returns false if
// the system does not know the child process. The child remains a zombie, so
// that its number is not given to another process.
bool WaitForEnd(pid_t child, double seconds, bool* is_slow) {
  using Clock = std::chrono::steady_clock;
  const auto deadline =
      Clock::now() + std::chrono::duration<double>(std::max(0.0, seconds));
  for (;;) {
    siginfo_t info{};
    const int error = waitid(P_PID, static_cast<id_t>(child), &info,
                             WEXITED | WNOHANG | WNOWAIT);
    if (error == 0 && info.si_pid == child) return true;
    if (error != 0 && errno != EINTR) return false;
    *is_slow = Clock::now() > deadline;
    if (*is_slow) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace

ChildEnd RunChild(const std::vector<std::string>& command,
                  const ChildLimits& limits) {
  using Kind = ChildEnd::Kind;
  std::vector<char*> argv;
  for (const std::string& word : command) {
    argv.push_back(const_cast<char*>(word.c_str()));
  }
  argv.push_back(nullptr);
  const ErrorPipe errors;
  if (!errors.is_open()) return {Kind::kNotStarted, errno};
  const pid_t child = fork();
  if (child < 0) return {Kind::kNotStarted, errno};
  if (child == 0) Become(argv.data(), limits, errors.writer());
  setpgid(child, child);  // Whichever process is first.
  bool is_slow = false;
  bool is_known = WaitForEnd(child, limits.seconds, &is_slow);
  // Only a zombie keeps the number of its group from other processes.
  if (is_known) kill(-child, SIGKILL);
  int status = 0;
  pid_t ended = -1;
  do {
    ended = waitpid(child, &status, 0);
  } while (ended < 0 && errno == EINTR);
  is_known = is_known && ended == child;
  if (is_slow) return {Kind::kTooSlow, 0};
  if (const int error = errors.Read()) return {Kind::kNotStarted, error};
  if (!is_known) return {Kind::kUnknown, 0};
  return WIFSIGNALED(status) ? ChildEnd{Kind::kSignal, WTERMSIG(status)}
                             : ChildEnd{Kind::kExited, WEXITSTATUS(status)};
}

}  // namespace poise
