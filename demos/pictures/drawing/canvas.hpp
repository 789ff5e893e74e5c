// SPDX-License-Identifier: MIT
#pragma once

#include <cairo.h>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>

#include "drawable.hpp"
#include "png_file.hpp"
#include "poster.hpp"

namespace boxstream::picture {

struct SurfaceDeleter {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct ContextDeleter {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using SurfacePtr = std::unique_ptr<cairo_surface_t, SurfaceDeleter>;
using ContextPtr = std::unique_ptr<cairo_t, ContextDeleter>;

struct Rect {
  double x, y, width, height;
};

/// The smallest of 1, 2, 5 times a power of ten that cuts `range` into at most `most` parts.
double nice_step(double range, int most);

/// What is on an image surface of format RGB24.
Image to_image(cairo_surface_t* surface);

enum class Align { left, centre, right };

/// The few strokes that a poster is made of. Lengths are in layout units; `y` grows downwards.
class Canvas {
 public:
  /// Draws on `surface`, which must outlive the canvas; one layout unit is `scale` pixels.
  Canvas(cairo_surface_t* surface, double scale);

  void fill(const Rect& rect, Colour colour, double radius = 0);
  void outline(const Rect& rect, Colour colour, double radius);
  void line(double x0, double y0, double x1, double y1, Colour colour, double width);
  /// `y` is the base line.
  void text(double x, double y, const std::string& text, double size, Colour colour, Align align = Align::left,
            bool bold = false);
  /// The same, smaller if it would be wider than `width`.
  void text_within(double width, double x, double y, const std::string& text, double size, Colour colour,
                   Align align = Align::left, bool bold = false);
  double text_width(const std::string& text, double size, bool bold = false);
  /// The image stretched over `rect`, with rounded corners.
  void image(const Rect& rect, const Image& image, double radius);

  /// For paths of many points.
  cairo_t* context() { return context_.get(); }
  void set_colour(Colour colour, double alpha = 1);

 private:
  void rounded(const Rect& rect, double radius);

  ContextPtr context_;
};

/// What cairo draws goes to `out`.
SurfacePtr svg_surface(std::ostream& out, double width, double height);
/// Throws std::runtime_error with the reason if something went wrong.
void check(cairo_status_t status);

/// Writes what `draw` draws on a page of that size, a PNG with two pixels a unit. Throws std::runtime_error.
void write_page(std::ostream& out, PictureFormat format, double width, double height,
                const std::function<void(Canvas&)>& draw);

}  // namespace boxstream::picture
