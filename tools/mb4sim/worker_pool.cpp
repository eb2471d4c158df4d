// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "worker_pool.hpp"

#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <deque>
#include <exception>

#include "interrupts.hpp"
#include "report/exit_status.hpp"
#include "report/messages.hpp"

namespace mb4::tool {
namespace {

struct Worker {
  pid_t process;
  int pipe;  // what it returns
};

void write_all(int pipe, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = ::write(pipe, text.data() + at, text.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    at += static_cast<std::size_t>(written);
  }
}

// Signals that interrupt the command: they come while it waits for a worker, else they wait.
class Signals {
 public:
  Signals() {
    sigset_t held;
    ::sigemptyset(&held);
    for (const int number : Interrupts::kSignals) ::sigaddset(&held, number);
    ::sigprocmask(SIG_BLOCK, &held, &mask_);
  }
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;
  ~Signals() { ::sigprocmask(SIG_SETMASK, &mask_, nullptr); }

  // Until there is something to read or, with fd < 0, not at all. Throws Interrupted.
  void wait(int fd) const {
    pollfd poll{fd, POLLIN, 0};
    const timespec none{0, 0};
    while (::ppoll(&poll, 1, fd < 0 ? &none : nullptr, &mask_) < 0) {
      interrupts_.check();
      if (errno != EINTR) throw UseError(fmt::format("ppoll: {}", std::strerror(errno)));
    }
    interrupts_.check();
  }
  // In a worker: as they were for the command, and the worker ends with it.
  void leave(pid_t command) const {
    interrupts_.restore();
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != command) ::_exit(kModelStopped);
    ::sigprocmask(SIG_SETMASK, &mask_, nullptr);
  }

 private:
  sigset_t mask_{};
  Interrupts interrupts_;
};

class Workers {
 public:
  Workers() = default;
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  // No worker process remains.
  ~Workers() {
    for (const Worker& worker : running_) ::kill(worker.process, SIGKILL);
    while (!running_.empty()) wait_for_oldest();
  }

  std::size_t count() const { return running_.size(); }

  void start(std::uint64_t number, const std::function<std::string(std::uint64_t)>& job) {
    int ends[2];
    if (::pipe(ends) != 0) throw UseError(fmt::format("pipe: {}", std::strerror(errno)));
    const pid_t command = ::getpid();
    const pid_t process = ::fork();
    if (process < 0) throw UseError(fmt::format("fork: {}", std::strerror(errno)));
    if (process != 0) {
      ::close(ends[1]);
      running_.push_back({process, ends[0]});
      return;
    }
    // The worker must not write the parent's buffers a second time.
    ::close(ends[0]);
    signals_.leave(command);
    try {
      write_all(ends[1], job(number));
    } catch (const std::exception& error) {
      print_error(false, error.what(), kModelStopped);
      ::_exit(kModelStopped);
    }
    ::_exit(kGood);
  }

  // What the oldest one returns; empty if it has died.
  std::string finish() {
    std::string text;
    char buffer[4096];
    for (ssize_t count = 1; count > 0;) {
      signals_.wait(running_.front().pipe);
      count = ::read(running_.front().pipe, buffer, sizeof(buffer));
      text.append(buffer, static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    }
    const int status = wait_for_oldest();
    if (WIFEXITED(status) && WEXITSTATUS(status) == kGood) return text;
    signals_.wait(-1);  // the signal that ended the worker may be for the command too
    return "";
  }

 private:
  int wait_for_oldest() {
    const Worker worker = running_.front();
    running_.pop_front();
    ::close(worker.pipe);
    int status = 0;
    while (::waitpid(worker.process, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
  }

  Signals signals_;
  std::deque<Worker> running_;
};

}  // namespace

void run_jobs(std::uint64_t count, unsigned workers,
              const std::function<std::string(std::uint64_t)>& job,
              const std::function<void(const std::string&)>& result) {
  std::fflush(stdout);
  std::fflush(stderr);
  // A result fits into the pipe's buffer, so that a worker never waits for its turn.
  Workers running;
  for (std::uint64_t next = 0; next < count || running.count() != 0;) {
    while (next < count && running.count() < workers) running.start(next++, job);
    result(running.finish());
    std::fflush(stdout);
  }
}

}  // namespace mb4::tool
