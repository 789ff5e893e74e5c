// SPDX-License-Identifier: MIT
#include "colour_bar.hpp"

#include <algorithm>

#include "canvas.hpp"

namespace boxstream::picture {
namespace {

constexpr Colour ink{0.12F, 0.16F, 0.22F};
constexpr Colour ground{1, 1, 1};
constexpr double width = 150, height = 10, inset = 12, pad = 8, text_size = 13;

void fill_with_colours(Canvas& canvas, const Rect& rect, const std::vector<Colour>& colours) {
  cairo_pattern_t* const pattern = cairo_pattern_create_linear(rect.x, 0, rect.x + rect.width, 0);
  const double last = std::max<double>(1, static_cast<double>(colours.size()) - 1);
  for (std::size_t i = 0; i < colours.size(); ++i)
    cairo_pattern_add_color_stop_rgb(pattern, static_cast<double>(i) / last, double{colours[i].r}, double{colours[i].g},
                                     double{colours[i].b});
  cairo_set_source(canvas.context(), pattern);
  cairo_rectangle(canvas.context(), rect.x, rect.y, rect.width, rect.height);
  cairo_fill(canvas.context());
  cairo_pattern_destroy(pattern);
}

}  // namespace

void draw_colour_bar(Canvas& canvas, const Rect& rect, const ColourBar& bar) {
  if (bar.colours.empty()) return;
  const double title = canvas.text_width(bar.title, text_size), low = canvas.text_width(bar.low, text_size),
               high = canvas.text_width(bar.high, text_size);
  const double all = pad + title + 2 * pad + low + pad + width + pad + high + pad;
  double x = rect.x + rect.width - inset - all;
  const double y = rect.y + rect.height - inset - height - pad;
  canvas.fill({x, y - pad, all, height + 2 * pad}, ground, 5);
  const auto write = [&](const std::string& text, double text_width) {
    x += pad;
    canvas.text(x, y + height - 0.5, text, text_size, ink);
    x += text_width;
  };
  write(bar.title, title + pad);
  write(bar.low, low);
  fill_with_colours(canvas, {x += pad, y, width, height}, bar.colours);
  x += width;
  write(bar.high, high);
}

Image with_colour_bar(const Image& image, const ColourBar& bar) {
  constexpr double scale = 1.25;
  const SurfacePtr surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height));
  Canvas canvas(surface.get(), scale);
  const Rect all{0, 0, image.width / scale, image.height / scale};
  canvas.image(all, image, 0);
  draw_colour_bar(canvas, all, bar);
  check(cairo_status(canvas.context()));
  return to_image(surface.get());
}

}  // namespace boxstream::picture
