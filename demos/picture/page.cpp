// SPDX-License-Identifier: MIT
#include "page.hpp"

#include <cairo-svg.h>

#include <stdexcept>

namespace boxstream::picture {

namespace {

void check(cairo_status_t status, const std::string& path) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error("cannot write " + path + ": " + cairo_status_to_string(status));
}

void draw_on(cairo_surface_t* surface, double scale, const std::function<void(Canvas&)>& draw) {
  Canvas canvas(surface, scale);
  draw(canvas);
}

}  // namespace

void write_page(const std::string& path, PictureFormat format, double width, double height,
                const std::function<void(Canvas&)>& draw) {
  if (format == PictureFormat::svg) {
    const SurfacePtr surface(cairo_svg_surface_create(path.c_str(), width, height));
    check(cairo_surface_status(surface.get()), path);
    draw_on(surface.get(), 1, draw);
    cairo_surface_finish(surface.get());
    check(cairo_surface_status(surface.get()), path);
  } else {
    constexpr double pixels = 2;
    const SurfacePtr surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(pixels * width),
                                                        static_cast<int>(pixels * height)));
    draw_on(surface.get(), pixels, draw);
    check(cairo_surface_write_to_png(surface.get(), path.c_str()), path);
  }
}

}  // namespace boxstream::picture
