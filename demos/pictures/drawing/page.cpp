// SPDX-License-Identifier: MIT
#include "page.hpp"

#include <cairo-svg.h>

#include <ostream>
#include <stdexcept>

namespace boxstream::picture {

namespace {

cairo_status_t write_to(void* out, const unsigned char* bytes, unsigned count) {
  // Whether it was written, and if not why, is known where the stream is from.
  static_cast<std::ostream*>(out)->write(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

void draw_on(cairo_surface_t* surface, double scale, const std::function<void(Canvas&)>& draw) {
  Canvas canvas(surface, scale);
  draw(canvas);
  check(cairo_status(canvas.context()));
}

}  // namespace

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("a picture: ") + cairo_status_to_string(status));
}

SurfacePtr svg_surface(std::ostream& out, double width, double height) {
  SurfacePtr surface(cairo_svg_surface_create_for_stream(write_to, &out, width, height));
  check(cairo_surface_status(surface.get()));
  return surface;
}

void write_page(std::ostream& out, PictureFormat format, double width, double height,
                const std::function<void(Canvas&)>& draw) {
  if (format == PictureFormat::svg) {
    const SurfacePtr surface = svg_surface(out, width, height);
    draw_on(surface.get(), 1, draw);
    cairo_surface_finish(surface.get());
    check(cairo_surface_status(surface.get()));
  } else {
    constexpr double pixels = 2;
    const SurfacePtr surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(pixels * width),
                                                        static_cast<int>(pixels * height)));
    draw_on(surface.get(), pixels, draw);
    check(cairo_surface_write_to_png_stream(surface.get(), write_to, &out));
  }
}

}  // namespace boxstream::picture
