// SPDX-License-Identifier: MIT
#include <cairo-svg.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string_view>

#include "picture/canvas.hpp"
#include "picture/poster.hpp"
#include "plot.hpp"

namespace boxstream::bench {

namespace {

using picture::Align;
using picture::Canvas;
using picture::Colour;

constexpr double width = 1000, height = 700;
constexpr picture::Rect area{70, 64, 740, 560};
constexpr double label_size = 14, label_pitch = 18;
constexpr Colour ink{0.12F, 0.16F, 0.22F}, faint_ink{0.42F, 0.46F, 0.52F}, grid{0.90F, 0.92F, 0.94F};
constexpr Colour our_colour{0.83F, 0.18F, 0.09F};

/// One colour a library: its members are told apart by their labels.
Colour colour_of(const PlotLine& line) {
  if (line.ours) return our_colour;
  const std::string_view name = line.name;
  if (name.substr(0, 4) == "cgal") return {0.10F, 0.44F, 0.70F};
  if (name.substr(0, 4) == "fcl-") return {0.25F, 0.58F, 0.30F};
  if (name.substr(0, 4) == "dbvt" || name.substr(0, 4) == "axis") return {0.55F, 0.35F, 0.68F};
  return {0.50F, 0.50F, 0.50F};
}

/// Whole powers of ten around the values.
struct Scale {
  int low = std::numeric_limits<int>::max(), high = std::numeric_limits<int>::min();

  void add(double value) {
    low = std::min(low, static_cast<int>(std::floor(std::log10(value) + 1e-9)));
    high = std::max(high, static_cast<int>(std::ceil(std::log10(value) - 1e-9)));
  }
  /// 0 at the low end, 1 at the high one.
  double place(double value) const { return (std::log10(value) - low) / std::max(1, high - low); }
};

class Drawing {
 public:
  Drawing(const Plot& plot, cairo_surface_t* surface, double scale) : plot_(plot), canvas_(surface, scale) {
    for (const PlotLine& line : plot.lines)
      for (const PlotLine::Point& p : line.points) {
        n_.add(p.n);
        value_.add(p.value);
      }
  }

  void draw() {
    canvas_.fill({0, 0, width, height}, {1, 1, 1});
    canvas_.text(area.x, 34, plot_.title, 20, ink, Align::left, true);
    canvas_.text(area.x, 54, plot_.unit, label_size, faint_ink);
    canvas_.text(area.x, height - 14, plot_.small_print, 12, faint_ink);
    draw_grid();
    // Ours last, above all others.
    for (auto line = plot_.lines.rbegin(); line != plot_.lines.rend(); ++line) draw_line(*line);
    draw_labels();
  }

 private:
  double x(double n) const { return area.x + area.width * n_.place(n); }
  double y(double value) const { return area.y + area.height * (1 - value_.place(value)); }

  void draw_grid() {
    const double bottom = area.y + area.height, right = area.x + area.width;
    for (int power = n_.low; power <= n_.high; ++power) {
      const double at = x(std::pow(10, power));
      canvas_.line(at, area.y, at, bottom, grid, 1);
      canvas_.text(at, bottom + 20, power < 4 ? fmt::format("{}", std::pow(10, power)) : fmt::format("1e{}", power),
                   label_size, faint_ink, Align::centre);
    }
    for (int power = value_.low; power <= value_.high; ++power) {
      const double at = y(std::pow(10, power));
      canvas_.line(area.x, at, right, at, grid, 1);
      canvas_.text(area.x - 8, at + 5, fmt::format("{:g}", std::pow(10, power)), label_size, faint_ink, Align::right);
    }
    canvas_.text(area.x + area.width / 2, bottom + 42, "n, boxes", label_size, faint_ink, Align::centre);
  }

  void draw_line(const PlotLine& line) {
    const Colour colour = colour_of(line);
    for (std::size_t i = 1; i < line.points.size(); ++i)
      canvas_.line(x(line.points[i - 1].n), y(line.points[i - 1].value), x(line.points[i].n), y(line.points[i].value),
                   colour, line.ours ? 4.5 : 1.6);
    const double radius = line.ours ? 5 : 2.6;
    for (const PlotLine::Point& p : line.points)
      canvas_.fill({x(p.n) - radius, y(p.value) - radius, 2 * radius, 2 * radius}, colour, radius);
  }

  /// Lines that end at the same n share a column of labels to the right of it.
  void draw_labels() {
    std::map<double, std::vector<Label>> columns;
    for (const PlotLine& line : plot_.lines)
      columns[line.points.back().n].push_back({&line, y(line.points.back().value)});
    for (auto& [n, labels] : columns) {
      spread(labels);
      const bool in_margin = n == columns.rbegin()->first;
      for (const Label& label : labels) draw_label(label, x(n) + (in_margin ? 30 : 14), !in_margin);
    }
  }

  struct Label {
    const PlotLine* line;
    double at;
  };

  /// Each as close to the end of its line as its neighbours allow.
  static void spread(std::vector<Label>& labels) {
    std::sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.at < b.at; });
    for (std::size_t i = 1; i < labels.size(); ++i)
      labels[i].at = std::max(labels[i].at, labels[i - 1].at + label_pitch);
    double lowest = area.y + area.height;
    for (auto label = labels.rbegin(); label != labels.rend(); ++label, lowest -= label_pitch)
      lowest = label->at = std::min(label->at, lowest);
  }

  void draw_label(const Label& label, double left, bool above_lines) {
    const PlotLine& line = *label.line;
    const PlotLine::Point& end = line.points.back();
    const Colour colour = colour_of(line);
    cairo_t* const context = canvas_.context();
    canvas_.set_colour(colour, 0.45);
    cairo_set_line_width(context, 0.8);
    cairo_move_to(context, x(end.n) + 5, y(end.value));
    cairo_line_to(context, left - 3, label.at);
    cairo_stroke(context);
    const double size = line.ours ? 17 : label_size;
    if (above_lines) {
      const double label_width = canvas_.text_width(line.name, size, line.ours);
      canvas_.fill({left - 2, label.at - 8, label_width + 4, 16}, {1, 1, 1}, 3);
    }
    canvas_.text(left, label.at + 5, line.name, size, colour, Align::left, line.ours);
  }

  const Plot& plot_;
  Canvas canvas_;
  Scale n_, value_;
};

void check(cairo_status_t status, const std::string& path) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(fmt::format("cannot write {}: {}", path, cairo_status_to_string(status)));
}

}  // namespace

void write_plot(const Plot& plot, const std::string& path) {
  const auto format = picture::picture_format(path);
  if (!format) throw std::runtime_error("a plot ends in .svg or .png: " + path);
  if (*format == picture::PictureFormat::svg) {
    const picture::SurfacePtr surface(cairo_svg_surface_create(path.c_str(), width, height));
    check(cairo_surface_status(surface.get()), path);
    Drawing(plot, surface.get(), 1).draw();
    cairo_surface_finish(surface.get());
    check(cairo_surface_status(surface.get()), path);
  } else {
    constexpr double pixels = 2;
    const picture::SurfacePtr surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(pixels * width),
                                                                 static_cast<int>(pixels * height)));
    Drawing(plot, surface.get(), pixels).draw();
    check(cairo_surface_write_to_png(surface.get(), path.c_str()), path);
  }
}

}  // namespace boxstream::bench
