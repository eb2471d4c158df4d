// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A file that appears complete or not at all.
#ifndef MB4SIM_TOOL_OUTPUT_FILE_HPP_
#define MB4SIM_TOOL_OUTPUT_FILE_HPP_

#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace mb4::tool {

class OutputFile {
 public:
  // Throws UseError at once if `path` cannot be written. An existing file keeps its content until
  // commit().
  explicit OutputFile(std::string path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  // Appends to the content that commit() writes. Throws UseError.
  void append(std::string_view content);
  // Gives the file its content. Throws UseError.
  void commit();
  void commit(std::string_view content) {
    append(content);
    commit();
  }

 private:
  std::string path_;
  std::string partial_;  // written first, then renamed; equals path_ for devices and pipes
  std::ofstream out_;
  bool committed_ = false;
};

// An output file and the option that asks for it.
struct Output {
  std::string option;
  std::string path;
};

// Throws UseError if one of `outputs` is the same file as one of `inputs` or as another output.
void require_distinct(const std::vector<Output>& outputs, const std::vector<std::string>& inputs);

// Throws UseError if there is something at `path` that is no regular file.
void require_regular(const std::string& path);

// `path` with symbolic links at its end followed, also to a file that does not exist yet.
std::string link_target(const std::string& path);

// Name under which an OutputFile is written before it is complete.
std::string partial_path(const std::string& path);

// Throws UseError if a file of this name cannot be created or overwritten. A file that did not
// exist before does not exist after the call.
void require_writable(const std::string& path);

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_OUTPUT_FILE_HPP_
