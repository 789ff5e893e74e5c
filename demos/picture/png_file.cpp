// SPDX-License-Identifier: MIT
#include "png_file.hpp"

#include <png.h>

#include <stdexcept>

namespace boxstream::picture {
namespace {

// libpng's simplified interface: one struct, messages instead of longjmp.
png_image rgb_image() {
  png_image file{};
  file.version = PNG_IMAGE_VERSION;
  return file;
}

[[noreturn]] void fail(png_image& file, const std::string& path) {
  const std::string reason = file.message;
  png_image_free(&file);
  throw std::runtime_error(path + ": " + reason);
}

}  // namespace

void write_png(const Image& image, const std::string& path) {
  png_image file = rgb_image();
  file.width = static_cast<png_uint_32>(image.width);
  file.height = static_cast<png_uint_32>(image.height);
  file.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&file, path.c_str(), 0, image.rgb.data(), 0, nullptr) == 0) fail(file, path);
}

Image read_png(const std::string& path) {
  png_image file = rgb_image();
  if (png_image_begin_read_from_file(&file, path.c_str()) == 0) fail(file, path);
  file.format = PNG_FORMAT_RGB;
  Image image;
  image.width = static_cast<int>(file.width);
  image.height = static_cast<int>(file.height);
  image.rgb.resize(PNG_IMAGE_SIZE(file));
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&file, &white, image.rgb.data(), 0, nullptr) == 0) fail(file, path);
  return image;
}

}  // namespace boxstream::picture
