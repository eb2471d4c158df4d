// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "worker_pool.hpp"

#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <deque>
#include <exception>

#include "exit_status.hpp"

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

std::string read_all(int pipe) {
  std::string text;
  char buffer[4096];
  while (true) {
    const ssize_t count = ::read(pipe, buffer, sizeof(buffer));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer, static_cast<std::size_t>(count));
  }
}

Worker start(std::uint64_t number, const std::function<std::string(std::uint64_t)>& job) {
  int ends[2];
  if (::pipe(ends) != 0) throw UseError(fmt::format("pipe: {}", std::strerror(errno)));
  const pid_t process = ::fork();
  if (process < 0) throw UseError(fmt::format("fork: {}", std::strerror(errno)));
  if (process != 0) {
    ::close(ends[1]);
    return {process, ends[0]};
  }
  // The worker: nothing of the parent's buffers may be written twice.
  ::close(ends[0]);
  try {
    write_all(ends[1], job(number));
  } catch (const std::exception& error) {
    fmt::print(stderr, "mb4sim: {}\n", error.what());
    ::_exit(kModelStopped);
  }
  ::_exit(kGood);
}

std::string finish(const Worker& worker) {
  std::string text = read_all(worker.pipe);
  ::close(worker.pipe);
  int status = 0;
  while (::waitpid(worker.process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == kGood ? text : "";
}

}  // namespace

void run_jobs(std::uint64_t count, unsigned workers,
              const std::function<std::string(std::uint64_t)>& job,
              const std::function<void(const std::string&)>& result) {
  std::fflush(stdout);
  std::fflush(stderr);
  // A result fits into the pipe's buffer, so that a worker never waits for its turn.
  std::deque<Worker> running;
  for (std::uint64_t next = 0; next < count || !running.empty();) {
    while (next < count && running.size() < workers) running.push_back(start(next++, job));
    const Worker oldest = running.front();
    running.pop_front();
    result(finish(oldest));
    std::fflush(stdout);
  }
}

}  // namespace mb4::tool
