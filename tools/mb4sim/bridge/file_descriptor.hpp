// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A file descriptor that is closed with its owner.
#ifndef MB4SIM_TOOL_FILE_DESCRIPTOR_HPP_
#define MB4SIM_TOOL_FILE_DESCRIPTOR_HPP_

#include <unistd.h>

#include <utility>

namespace mb4::tool {

class FileDescriptor {
 public:
  explicit FileDescriptor(int fd = -1) : fd_(fd) {}
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~FileDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }

  int get() const { return fd_; }
  explicit operator bool() const { return fd_ >= 0; }

 private:
  int fd_;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_FILE_DESCRIPTOR_HPP_
