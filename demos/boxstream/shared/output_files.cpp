// SPDX-License-Identifier: MIT
#include "boxstream/shared/output_files.hpp"

#include "boxstream/shared/bad_input.hpp"

namespace boxstream::tool {

std::optional<picture::PictureFormat> checked_format(const std::string& picture) {
  const auto format = picture::picture_format(picture);
  if (!picture.empty() && !format) throw BadInput(picture + ": a picture is a .png or a .svg file");
  return format;
}

}  // namespace boxstream::tool
