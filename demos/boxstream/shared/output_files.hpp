// SPDX-License-Identifier: MIT
#pragma once

#include <list>
#include <optional>
#include <ostream>
#include <string>

#include "base/output_file.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "pictures/drawing/poster.hpp"

namespace boxstream::tool {

/// The files that a command writes. They are opened before its work, so that what cannot be written is found out early,
/// and put in their places after it, or not at all.
class OutputFiles {
 public:
  /// Null for an empty path: not wanted. Throws as files::OutputFile does.
  std::ostream* add(const std::string& path, files::Input input = files::Input::must_stay) {
    return path.empty() ? nullptr : &files_.emplace_back(path, input).stream();
  }
  void commit() {
    for (files::OutputFile& file : files_) file.commit();
  }

 private:
  std::list<files::OutputFile> files_;
};

/// None for an empty path. Throws BadInput for a file that is no picture.
inline std::optional<picture::PictureFormat> checked_format(const std::string& picture) {
  const auto format = picture::picture_format(picture);
  if (!picture.empty() && !format) throw BadInput(picture + ": a picture is a .png or a .svg file");
  return format;
}

}  // namespace boxstream::tool
