// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "report/output_file.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "report/exit_status.hpp"

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

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return true;
  const auto plain = [&](const std::string& path) {
    const fs::path absolute = fs::absolute(link_target(path), error);
    const fs::path canonical = fs::weakly_canonical(absolute, error);
    return error ? absolute.lexically_normal() : canonical;
  };
  return plain(a) == plain(b);
}

}  // namespace

std::string link_target(const std::string& path) {
  constexpr int kMaxLinks = 40;  // as Linux follows
  fs::path target(path);
  std::error_code error;
  for (int i = 0; i < kMaxLinks && fs::is_symlink(fs::symlink_status(target, error)); ++i) {
    const fs::path next = fs::read_symlink(target, error);
    if (error) break;
    target = target.parent_path() / next;
  }
  return target.string();
}

std::string partial_path(const std::string& path) {
  return is_special(path) ? path : path + ".partial";
}

void require_regular(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::none) {
    throw UseError(fmt::format("{}: cannot write: {}", path, error.message()));
  }
  if (!fs::exists(status) || fs::is_regular_file(status)) return;
  throw UseError(fmt::format("{}: cannot write: it is {}", path,
                             fs::is_directory(status) ? "a directory" : "not a regular file"));
}

void require_distinct(const std::vector<Output>& outputs, const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto& [option, path] = outputs[i];
    for (const std::string& input : inputs) {
      if (same_file(path, input)) {
        throw UseError(fmt::format("{}: {} would replace the input {}", option, path, input));
      }
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (outputs[k].option == option && outputs[k].path == path) continue;
      if (same_file(path, outputs[k].path)) {
        throw UseError(fmt::format("{}: {} is the same file as {} of {}", option, path,
                                   outputs[k].path, outputs[k].option));
      }
    }
  }
}

OutputFile::OutputFile(std::string path) : path_(std::move(path)), partial_(partial_path(path_)) {
  require_writable(path_);
  if (partial_ == path_) return;
  require_regular(partial_);
  errno = 0;
  out_.open(partial_, std::ios::binary);
  if (!out_) fail(path_);
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!committed_ && partial_ != path_) fs::remove(partial_, ignored);
}

// A pipe is opened when there is something to write: opening it waits for its reader.
void OutputFile::append(std::string_view content) {
  errno = 0;
  if (!out_.is_open()) out_.open(partial_, std::ios::binary);
  out_.write(content.data(), static_cast<std::streamsize>(content.size()));
  if (!out_) fail(path_);
}

void OutputFile::commit() {
  append("");
  out_.close();
  if (!out_) fail(path_);
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
  if (is_special(path)) {
    // To open and close a pipe for a test would show its reader the end of the data.
    if (::access(path.c_str(), W_OK) != 0) fail(path);
    return;
  }
  const bool existed = fs::exists(path, ignored);
  errno = 0;
  if (!std::ofstream(path, std::ios::binary | std::ios::app)) fail(path);
  // A link to a file that was not there stays.
  if (!existed) fs::remove(link_target(path), ignored);
}

}  // namespace mb4::tool
