// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
#include "report/picture_file.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "report/exit_status.hpp"
#include "sim/core/one_line.hpp"

namespace mb4::tool {
namespace {

namespace fs = std::filesystem;

constexpr const char* kConverter = "rsvg-convert";

std::string ending(const std::string& path) {
  std::string text = fs::path(path).extension().string();
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool has_converter() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access((folder + "/" + kConverter).c_str(), X_OK) == 0) return true;
  }
  return false;
}

// Checks the name. Returns whether it is a PNG file.
bool is_png(const std::string& path) {
  for (const char* other : {".jpg", ".jpeg", ".gif", ".pdf", ".webp", ".bmp"}) {
    if (ending(path) == other) {
      throw UseError(fmt::format("--svg: {}: a picture is an .svg or a .png file, not a {} file",
                                 sim::one_line(path), other));
    }
  }
  if (ending(path) != ".png") return false;
  if (!has_converter()) {
    throw UseError(
        fmt::format("--svg: {}: a PNG file needs {} (package librsvg2-bin); give the name .svg",
                    sim::one_line(path), kConverter));
  }
  return true;
}

// A file with this content as long as the object exists.
class Scratch {
 public:
  explicit Scratch(const std::string& content) {
    std::string name = (fs::temp_directory_path() / "mb4sim-XXXXXX").string();
    const int file = ::mkstemp(name.data());
    if (file < 0) throw UseError("--svg: cannot write a temporary file");
    path_ = name;
    std::FILE* const out = ::fdopen(file, "w");
    std::fwrite(content.data(), 1, content.size(), out);
    std::fclose(out);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { std::remove(path_.c_str()); }

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// The name of the temporary file stands in single quotes: TMPDIR may hold anything but these.
std::string png_of(const std::string& svg) {
  const Scratch scratch(svg);
  if (scratch.path().find('\'') != std::string::npos) {
    throw UseError("--svg: TMPDIR holds a quote");
  }
  const std::string command = fmt::format("{} --format=png '{}'", kConverter, scratch.path());
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  std::string png;
  char part[65536];
  while (pipe != nullptr) {
    const std::size_t size = std::fread(part, 1, sizeof part, pipe);
    if (size == 0) break;
    png.append(part, size);
  }
  if (pipe == nullptr || ::pclose(pipe) != 0 || png.empty()) {
    throw UseError(fmt::format("--svg: {} has failed", kConverter));
  }
  return png;
}

}  // namespace

PictureFile::PictureFile(const std::string& path) : png_(is_png(path)), path_(path), file_(path) {}

void PictureFile::commit(const std::string& svg) { file_.commit(png_ ? png_of(svg) : svg); }

}  // namespace mb4::tool
