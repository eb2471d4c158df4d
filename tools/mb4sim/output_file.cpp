// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "output_file.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "exit_status.hpp"

namespace mb4::tool {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path) {
  throw UseError(fmt::format("{}: cannot write: {}", path, std::strerror(errno)));
}

bool is_special(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status);
}

}  // namespace

OutputFile::OutputFile(std::string path)
    : path_(std::move(path)), partial_(is_special(path_) ? path_ : path_ + ".partial") {
  require_writable(path_);
  if (partial_ == path_) return;
  errno = 0;
  if (!std::ofstream(partial_, std::ios::binary)) fail(path_);
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!committed_ && partial_ != path_) fs::remove(partial_, ignored);
}

void OutputFile::commit(std::string_view content) {
  errno = 0;
  std::ofstream out(partial_, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) fail(path_);
  if (partial_ != path_) {
    std::error_code error;
    fs::rename(partial_, path_, error);
    if (error) throw UseError(fmt::format("{}: cannot write: {}", path_, error.message()));
  }
  committed_ = true;
}

void require_writable(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    errno = EISDIR;
    fail(path);
  }
  const bool existed = fs::exists(path, ignored);
  errno = 0;
  if (!std::ofstream(path, std::ios::binary | std::ios::app)) fail(path);
  if (!existed) fs::remove(path, ignored);
}

}  // namespace mb4::tool
