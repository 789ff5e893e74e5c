// SPDX-License-Identifier: MIT
#include "poster.hpp"

#include <cairo-svg.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "canvas.hpp"
#include "chart.hpp"
#include "colour_bar.hpp"
#include "png_file.hpp"

namespace boxstream::picture {
namespace {

// Lengths in layout units; a poster is `page_width` of them wide.
constexpr double page_width = 1280;
constexpr double margin = 36;
constexpr double gap = 20;
constexpr double head_height = 96;
constexpr double label_height = 40;
constexpr double figure_height = 92;
constexpr double chart_height = 270;
constexpr double print_line = 20;
constexpr double scale = poster_width / page_width;

constexpr Colour paper{1, 1, 1};
constexpr Colour tile{0.955F, 0.965F, 0.975F};
constexpr Colour edge{0.84F, 0.87F, 0.90F};
constexpr Colour ink{0.12F, 0.16F, 0.22F};
constexpr Colour faint_ink{0.42F, 0.46F, 0.52F};

double column_width(std::size_t count) {
  const auto n = static_cast<double>(count);
  return (page_width - 2 * margin - gap * (n - 1)) / n;
}

double panel_height(std::size_t count) {
  return column_width(count) * (count == 1 ? 0.5 : 0.64);
}

double page_height(const Poster& p) {
  double height = head_height + margin;
  if (!p.panels.empty()) height += label_height + panel_height(p.panels.size()) + gap;
  if (!p.figures.empty()) height += figure_height + gap;
  if (!p.charts.empty()) height += chart_height + gap;
  if (!p.small_print.empty()) height += print_line * static_cast<double>(p.small_print.size());
  return height;
}

void draw_panels(Canvas& canvas, double y, const std::vector<Panel>& panels) {
  const double width = column_width(panels.size());
  double x = margin;
  for (const Panel& panel : panels) {
    canvas.fill({x, y + 6, 6, 24}, panel.accent, 3);
    canvas.text(x + 16, y + 25, panel.label, 20, ink, Align::left, true);
    canvas.text(x + width, y + 25, panel.note, 15, faint_ink, Align::right);
    const Rect rect{x, y + label_height, width, panel_height(panels.size())};
    canvas.image(rect, panel.image, 8);
    canvas.outline(rect, edge, 8);
    draw_colour_bar(canvas, rect, panel.bar);
    x += width + gap;
  }
}

void draw_figures(Canvas& canvas, double y, const std::vector<Figure>& figures) {
  const double width = column_width(figures.size());
  double x = margin;
  for (const Figure& figure : figures) {
    canvas.fill({x, y, width, figure_height}, tile, 8);
    canvas.text_within(width - 24, x + width / 2, y + 46, figure.value, 28, figure.colour, Align::centre, true);
    canvas.text_within(width - 24, x + width / 2, y + 74, figure.caption, 14, faint_ink, Align::centre);
    x += width + gap;
  }
}

void draw(Canvas& canvas, const Poster& poster) {
  canvas.fill({0, 0, page_width, page_height(poster)}, paper);
  canvas.text(margin, 50, poster.title, 32, ink, Align::left, true);
  canvas.text_within(page_width - 2 * margin, margin, 80, poster.subtitle, 17, faint_ink);
  double y = head_height;
  if (!poster.panels.empty()) {
    draw_panels(canvas, y, poster.panels);
    y += label_height + panel_height(poster.panels.size()) + gap;
  }
  if (!poster.figures.empty()) {
    draw_figures(canvas, y, poster.figures);
    y += figure_height + gap;
  }
  if (!poster.charts.empty()) {
    const double width = column_width(poster.charts.size());
    for (std::size_t i = 0; i < poster.charts.size(); ++i)
      draw_chart(canvas, {margin + (width + gap) * static_cast<double>(i), y, width, chart_height}, poster.charts[i]);
    y += chart_height + gap;
  }
  for (const std::string& text : poster.small_print) {
    canvas.text_within(page_width - 2 * margin, margin, y + 12, text, 13, faint_ink);
    y += print_line;
  }
}

}  // namespace

std::optional<PictureFormat> picture_format(std::string_view path) {
  const auto ends_with = [path](std::string_view ending) {
    return path.size() > ending.size() && std::equal(ending.rbegin(), ending.rend(), path.rbegin(), [](char a, char b) {
             return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
           });
  };
  if (ends_with(".png")) return PictureFormat::png;
  if (ends_with(".svg")) return PictureFormat::svg;
  return std::nullopt;
}

PanelSize panel_size(int count) {
  const auto n = static_cast<std::size_t>(std::max(count, 1));
  return {static_cast<int>(column_width(n) * scale), static_cast<int>(panel_height(n) * scale)};
}

void write_poster(const Poster& poster, std::ostream& out, PictureFormat format) {
  const double height = page_height(poster);
  const bool vectors = format == PictureFormat::svg;
  const SurfacePtr surface(vectors ? svg_surface(out, poster_width, height * scale)
                                   : SurfacePtr(cairo_image_surface_create(CAIRO_FORMAT_RGB24, poster_width,
                                                                           static_cast<int>(height * scale))));
  check(cairo_surface_status(surface.get()));
  {
    Canvas canvas(surface.get(), scale);
    draw(canvas, poster);
    check(cairo_status(canvas.context()));
  }
  if (!vectors) return write_png(to_image(surface.get()), out);
  cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()));
}

}  // namespace boxstream::picture
