// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "worker_pool.hpp"

#include <fmt/core.h>
#include <poll.h>
#include <sched.h>
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
#include <optional>
#include <utility>
#include <vector>

#include "interrupts.hpp"
#include "report/exit_status.hpp"
#include "report/messages.hpp"

namespace mb4::tool {
namespace {

struct Worker {
  pid_t process;
  int pipe;          // what it returns; -1: it has ended
  std::string text;  // what has come; empty if it has died
};

void write_all(int pipe, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = ::write(pipe, text.data() + at, text.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    at += static_cast<std::size_t>(written);
  }
}

// Signals that interrupt the command. They are blocked except while it waits for a worker.
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

  // Waits until one of these has something to read. Without any it only takes signals that have
  // come. Throws Interrupted.
  void wait(std::vector<pollfd>& some) const {
    const timespec none{0, 0};
    while (::ppoll(some.data(), some.size(), some.empty() ? &none : nullptr, &mask_) < 0) {
      interrupts_.check();
      if (errno != EINTR) throw UseError(fmt::format("ppoll: {}", std::strerror(errno)));
    }
    interrupts_.check();
  }
  // For a worker: signals are again as they were for the command, and the worker ends with it.
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
    for (Worker& worker : all_) {
      if (worker.pipe < 0) continue;
      ::kill(worker.process, SIGKILL);
      end(worker);
    }
  }

  bool empty() const { return all_.empty(); }
  unsigned running() const { return running_; }

  void start(std::uint64_t number, const std::function<std::string(std::uint64_t)>& job) {
    int ends[2];
    if (::pipe(ends) != 0) throw UseError(fmt::format("pipe: {}", std::strerror(errno)));
    const pid_t command = ::getpid();
    const pid_t process = ::fork();
    if (process < 0) throw UseError(fmt::format("fork: {}", std::strerror(errno)));
    if (process != 0) {
      ::close(ends[1]);
      all_.push_back({process, ends[0], ""});
      ++running_;
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

  // Waits until a worker has something to say or ends.
  void wait() {
    std::vector<pollfd> pipes;
    for (const Worker& worker : all_) {
      if (worker.pipe >= 0) pipes.push_back({worker.pipe, POLLIN, 0});
    }
    signals_.wait(pipes);
    auto pipe = pipes.begin();
    for (Worker& worker : all_) {
      if (worker.pipe >= 0 && pipe++->revents != 0) read(worker);
    }
  }

  // What the oldest one has returned, if it has ended.
  std::optional<std::string> finished() {
    if (all_.empty() || all_.front().pipe >= 0) return std::nullopt;
    std::string text = std::move(all_.front().text);
    all_.pop_front();
    return text;
  }

 private:
  void read(Worker& worker) {
    char buffer[4096];
    const ssize_t count = ::read(worker.pipe, buffer, sizeof(buffer));
    if (count > 0) worker.text.append(buffer, static_cast<std::size_t>(count));
    if (count > 0 || end(worker)) return;
    worker.text.clear();
    std::vector<pollfd> none;
    signals_.wait(none);  // the signal that ended the worker may be for the command too
  }
  // Returns whether it ended well.
  bool end(Worker& worker) {
    ::close(worker.pipe);
    worker.pipe = -1;
    --running_;
    int status = 0;
    while (::waitpid(worker.process, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == kGood;
  }

  Signals signals_;
  std::deque<Worker> all_;  // those that run, and those whose turn has not come
  unsigned running_ = 0;
};

}  // namespace

unsigned usable_cores() {
  cpu_set_t cores;
  if (::sched_getaffinity(0, sizeof(cores), &cores) != 0) return 1;
  return static_cast<unsigned>(std::max(1, CPU_COUNT(&cores)));
}

void run_jobs(std::uint64_t count, unsigned workers,
              const std::function<std::string(std::uint64_t)>& job,
              const std::function<void(const std::string&)>& result) {
  std::fflush(stdout);
  std::fflush(stderr);
  // A worker that has ended makes room for the next one before its own turn comes.
  Workers all;
  for (std::uint64_t next = 0; next < count || !all.empty();) {
    while (next < count && all.running() < workers) all.start(next++, job);
    all.wait();
    while (const std::optional<std::string> text = all.finished()) result(*text);
    std::fflush(stdout);
  }
}

}  // namespace mb4::tool
