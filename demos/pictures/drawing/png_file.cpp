// SPDX-License-Identifier: MIT
#include "png_file.hpp"

#include <png.h>

#include <ostream>
#include <stdexcept>
#include <vector>

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

// To memory, since on failure libpng removes the file that it was given, device nodes included.
void write_png(const Image& image, std::ostream& out) {
  png_image file = rgb_image();
  file.width = static_cast<png_uint_32>(image.width);
  file.height = static_cast<png_uint_32>(image.height);
  file.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(file);
  std::vector<char> bytes(size);
  if (png_image_write_to_memory(&file, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) == 0) fail(file, "a PNG");
  out.write(bytes.data(), static_cast<std::streamsize>(size));
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
