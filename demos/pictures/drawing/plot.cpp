// SPDX-License-Identifier: MIT
#include "plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

#include "base/output_file.hpp"
#include "canvas.hpp"

namespace boxstream::picture {

namespace {

constexpr double width = 1000, height = 700;
constexpr Rect area{70, 64, 715, 560};
constexpr double label_size = 14, label_pitch = 18;

struct Paper {
  Colour ground, ink, faint_ink, grid;
};
constexpr Paper light{{1, 1, 1}, {0.12F, 0.16F, 0.22F}, {0.42F, 0.46F, 0.52F}, {0.90F, 0.92F, 0.94F}};
constexpr Paper dark{{0.05F, 0.07F, 0.09F}, {0.90F, 0.92F, 0.95F}, {0.58F, 0.62F, 0.67F}, {0.15F, 0.18F, 0.21F}};

constexpr Colour palette[] = {{0.10F, 0.44F, 0.70F}, {0.25F, 0.58F, 0.30F}, {0.55F, 0.35F, 0.68F},
                              {0.80F, 0.52F, 0.10F}, {0.10F, 0.60F, 0.62F}, {0.72F, 0.35F, 0.55F},
                              {0.45F, 0.42F, 0.20F}, {0.50F, 0.50F, 0.50F}};

/// As far from black as lines on dark paper have to be.
Colour lightened(Colour colour) {
  const auto lighter = [](float part) { return part + (1 - part) * 0.4F; };
  return {lighter(colour.r), lighter(colour.g), lighter(colour.b)};
}

Colour colour_on_white(const Plot& plot, const PlotLine& line) {
  if (line.ours) return our_colour;
  if (line.colour) return *line.colour;
  std::size_t place = 0;
  for (const PlotLine* other = plot.lines.data(); other != &line; ++other) place += !other->ours && !other->colour;
  return palette[place % std::size(palette)];
}

Colour colour_of(const Plot& plot, const PlotLine& line) {
  const Colour colour = colour_on_white(plot, line);
  return plot.dark ? lightened(colour) : colour;
}

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// Whole powers of ten around the values, or round steps from 0 on.
class Scale {
 public:
  explicit Scale(Axis axis) : axis_(axis) {}

  void add(double value) {
    least_ = std::min(least_, value);
    most_ = std::max(most_, value);
  }

  /// 0 at the low end, 1 at the high one.
  double place(double value) const {
    if (axis_ == Axis::linear) return value / (steps() * step());
    return (std::log10(value) - low()) / std::max(1, high() - low());
  }

  struct Tick {
    double value;
    std::string text;
  };
  /// `powers`: write the larger powers of ten as 1e4.
  std::vector<Tick> ticks(bool powers) const {
    std::vector<Tick> all;
    if (axis_ == Axis::linear) {
      for (int i = 0; i <= steps(); ++i) all.push_back({i * step(), number(i * step())});
    } else {
      for (int power = low(); power <= high(); ++power) {
        const double value = std::pow(10, power);
        all.push_back({value, powers && power >= 4 ? "1e" + std::to_string(power) : number(value)});
      }
    }
    return all;
  }

 private:
  int low() const { return static_cast<int>(std::floor(std::log10(least_) + 1e-9)); }
  int high() const { return static_cast<int>(std::ceil(std::log10(most_) - 1e-9)); }
  double step() const { return nice_step(std::max(most_, 1e-300), 6); }
  int steps() const { return std::max(1, static_cast<int>(std::ceil(most_ / step() - 1e-9))); }

  Axis axis_;
  double least_ = std::numeric_limits<double>::infinity(), most_ = 0;
};

class Drawing {
 public:
  Drawing(const Plot& plot, Canvas& canvas)
      : plot_(plot), paper_(plot.dark ? dark : light), canvas_(canvas), x_(plot.x), y_(plot.y) {
    for (const PlotLine& line : plot.lines)
      for (const PlotLine::Point& p : line.points) {
        x_.add(p.x);
        if (!p.failed) y_.add(p.y);
      }
  }

  void draw() {
    canvas_.fill({0, 0, width, height}, paper_.ground);
    canvas_.text(area.x, 34, plot_.title, 20, paper_.ink, Align::left, true);
    canvas_.text(area.x, 54, plot_.unit, label_size, paper_.faint_ink);
    canvas_.text(area.x, height - 14, plot_.small_print, 12, paper_.faint_ink);
    draw_grid();
    // Ours last, above all others.
    for (auto line = plot_.lines.rbegin(); line != plot_.lines.rend(); ++line) draw_line(*line);
    draw_labels();
  }

 private:
  double x(double value) const { return area.x + area.width * x_.place(value); }
  double y(double value) const { return area.y + area.height * (1 - y_.place(value)); }
  double y(const PlotLine::Point& p) const { return p.failed ? area.y : y(p.y); }

  void draw_grid() {
    const double bottom = area.y + area.height, right = area.x + area.width;
    for (const Scale::Tick& tick : x_.ticks(true)) {
      const double at = x(tick.value);
      canvas_.line(at, area.y, at, bottom, paper_.grid, 1);
      canvas_.text(at, bottom + 20, tick.text, label_size, paper_.faint_ink, Align::centre);
    }
    for (const Scale::Tick& tick : y_.ticks(false)) {
      const double at = y(tick.value);
      canvas_.line(area.x, at, right, at, paper_.grid, 1);
      canvas_.text(area.x - 8, at + 5, tick.text, label_size, paper_.faint_ink, Align::right);
    }
    canvas_.text(area.x + area.width / 2, bottom + 42, plot_.x_label, label_size, paper_.faint_ink, Align::centre);
  }

  void draw_line(const PlotLine& line) {
    const Colour colour = colour_of(plot_, line);
    for (std::size_t i = 1; i < line.points.size(); ++i)
      if (!line.points[i - 1].failed && !line.points[i].failed)
        canvas_.line(x(line.points[i - 1].x), y(line.points[i - 1].y), x(line.points[i].x), y(line.points[i].y), colour,
                     line.ours ? 4.5 : 1.6);
    const double radius = line.ours ? 5 : 2.6;
    for (const PlotLine::Point& p : line.points) {
      const double left = x(p.x), top = y(p);
      if (p.failed) {
        canvas_.line(left - 5, top - 5, left + 5, top + 5, colour, 2);
        canvas_.line(left - 5, top + 5, left + 5, top - 5, colour, 2);
      } else {
        canvas_.fill({left - radius, top - radius, 2 * radius, 2 * radius}, colour, radius);
      }
      if (!p.label.empty()) canvas_.text(left + 4, top - 10, p.label, 12, colour);
    }
  }

  /// Lines that end at the same x share a column of labels to the right of it.
  void draw_labels() {
    std::map<double, std::vector<Label>> columns;
    for (const PlotLine& line : plot_.lines) columns[line.points.back().x].push_back({&line, y(line.points.back())});
    for (auto& [end, labels] : columns) {
      spread(labels);
      const bool in_margin = end == columns.rbegin()->first;
      for (const Label& label : labels) draw_label(label, x(end) + (in_margin ? 30 : 14), !in_margin);
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
    const Colour colour = colour_of(plot_, line);
    cairo_t* const context = canvas_.context();
    canvas_.set_colour(colour, 0.45);
    cairo_set_line_width(context, 0.8);
    cairo_move_to(context, x(end.x) + 5, y(end));
    cairo_line_to(context, left - 3, label.at);
    cairo_stroke(context);
    const double size = line.ours ? 17 : label_size;
    if (above_lines) {
      const double label_width = canvas_.text_width(line.name, size, line.ours);
      canvas_.fill({left - 2, label.at - 8, label_width + 4, 16}, paper_.ground, 3);
    }
    canvas_.text(left, label.at + 5, line.name, size, colour, Align::left, line.ours);
  }

  const Plot& plot_;
  const Paper& paper_;
  Canvas& canvas_;
  Scale x_, y_;
};

}  // namespace

void write_plot(const Plot& plot, const std::string& path) {
  const auto format = picture_format(path);
  if (!format) throw std::runtime_error("a plot ends in .svg or .png: " + path);
  files::OutputFile file(path);
  write_plot(plot, file.stream(), *format);
  file.commit();
}

void write_plot(const Plot& plot, std::ostream& out, PictureFormat format) {
  write_page(out, format, width, height, [&](Canvas& canvas) { Drawing(plot, canvas).draw(); });
}

}  // namespace boxstream::picture
