// SPDX-FileCopyrightText: 2026 The openmb4 authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture as a file: SVG, or PNG by the name of the file.
#ifndef MB4SIM_TOOL_PICTURE_FILE_HPP_
#define MB4SIM_TOOL_PICTURE_FILE_HPP_

#include <string>

#include "report/output_file.hpp"

namespace mb4::tool {

class PictureFile {
 public:
  // Throws UseError if the file cannot be written, if its name asks for another format, or for PNG
  // if rsvg-convert, which makes it, is not there.
  explicit PictureFile(const std::string& path);
  // Throws UseError.
  void commit(const std::string& svg);

 private:
  bool png_;
  std::string path_;
  OutputFile file_;
};

}  // namespace mb4::tool

#endif  // MB4SIM_TOOL_PICTURE_FILE_HPP_
