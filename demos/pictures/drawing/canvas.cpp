// SPDX-License-Identifier: MIT
#include <cairo-svg.h>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <ostream>
#include <stdexcept>

#include "canvas.hpp"

namespace boxstream::picture {
namespace {

SurfacePtr to_surface(const Image& image) {
  SurfacePtr surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height));
  unsigned char* const data = cairo_image_surface_get_data(surface.get());
  if (!data) return surface;
  const int stride = cairo_image_surface_get_stride(surface.get());
  const std::uint8_t* from = image.rgb.data();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x, from += 3) {
      const std::uint32_t pixel = std::uint32_t{from[0]} << 16 | std::uint32_t{from[1]} << 8 | from[2];
      std::memcpy(data + std::ptrdiff_t{y} * stride + std::ptrdiff_t{x} * 4, &pixel, 4);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

}  // namespace

Canvas::Canvas(cairo_surface_t* surface, double scale) : context_(cairo_create(surface)) {
  cairo_scale(context_.get(), scale, scale);
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
}

void Canvas::set_colour(Colour c, double alpha) {
  cairo_set_source_rgba(context_.get(), c.r, c.g, c.b, alpha);
}

void Canvas::rounded(const Rect& r, double radius) {
  cairo_t* const c = context_.get();
  if (radius <= 0) {
    cairo_rectangle(c, r.x, r.y, r.width, r.height);
    return;
  }
  constexpr double quarter = std::numbers::pi / 2;
  cairo_new_sub_path(c);
  cairo_arc(c, r.x + r.width - radius, r.y + radius, radius, -quarter, 0);
  cairo_arc(c, r.x + r.width - radius, r.y + r.height - radius, radius, 0, quarter);
  cairo_arc(c, r.x + radius, r.y + r.height - radius, radius, quarter, 2 * quarter);
  cairo_arc(c, r.x + radius, r.y + radius, radius, 2 * quarter, 3 * quarter);
  cairo_close_path(c);
}

void Canvas::fill(const Rect& rect, Colour colour, double radius) {
  set_colour(colour);
  rounded(rect, radius);
  cairo_fill(context_.get());
}

void Canvas::outline(const Rect& rect, Colour colour, double radius) {
  set_colour(colour);
  rounded(rect, radius);
  cairo_set_line_width(context_.get(), 1);
  cairo_stroke(context_.get());
}

void Canvas::line(double x0, double y0, double x1, double y1, Colour colour, double width) {
  set_colour(colour);
  cairo_set_line_width(context_.get(), width);
  cairo_move_to(context_.get(), x0, y0);
  cairo_line_to(context_.get(), x1, y1);
  cairo_stroke(context_.get());
}

double Canvas::text_width(const std::string& text, double size, bool bold) {
  cairo_t* const c = context_.get();
  cairo_select_font_face(c, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c, size);
  cairo_text_extents_t extents;
  cairo_text_extents(c, text.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(double x, double y, const std::string& text, double size, Colour colour, Align align, bool bold) {
  const double width = text_width(text, size, bold);
  const double shift = align == Align::left ? 0 : align == Align::centre ? width / 2 : width;
  set_colour(colour);
  cairo_move_to(context_.get(), x - shift, y);
  cairo_show_text(context_.get(), text.c_str());
}

void Canvas::text_within(double width, double x, double y, const std::string& text, double size, Colour colour,
                         Align align, bool bold) {
  const double natural = text_width(text, size, bold);
  this->text(x, y, text, natural > width ? size * width / natural : size, colour, align, bold);
}

void Canvas::image(const Rect& rect, const Image& image, double radius) {
  const SurfacePtr surface = to_surface(image);
  cairo_t* const c = context_.get();
  cairo_save(c);
  rounded(rect, radius);
  cairo_clip(c);
  cairo_translate(c, rect.x, rect.y);
  cairo_scale(c, rect.width / image.width, rect.height / image.height);
  cairo_set_source_surface(c, surface.get(), 0, 0);
  cairo_paint(c);
  cairo_restore(c);
}

Image to_image(cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  Image image{cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
  image.rgb.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
  const unsigned char* const data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      std::uint32_t pixel;
      std::memcpy(&pixel, data + std::ptrdiff_t{y} * stride + std::ptrdiff_t{x} * 4, 4);
      for (const int shift : {16, 8, 0}) image.rgb.push_back(static_cast<std::uint8_t>(pixel >> shift));
    }
  }
  return image;
}

double nice_step(double range, int most) {
  const double rough = range / most;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

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
