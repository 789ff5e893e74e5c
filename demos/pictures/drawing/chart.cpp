// SPDX-License-Identifier: MIT
#include "chart.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "canvas.hpp"

namespace boxstream::picture {
namespace {

constexpr Colour ink{0.12F, 0.16F, 0.22F};
constexpr Colour faint_ink{0.42F, 0.46F, 0.52F};
constexpr Colour grid{0.90F, 0.92F, 0.94F};

std::string tick_label(double value, double step) {
  char text[40];
  if (step >= 1000 && std::fmod(step, 1000) == 0) {
    std::snprintf(text, sizeof text, value == 0 ? "0" : "%.0f k", value / 1000);
  } else {
    const int decimals = step >= 1 ? 0 : static_cast<int>(std::ceil(-std::log10(step) - 1e-9));
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
  }
  return text;
}

std::vector<double> sorted_values(const Chart& chart) {
  std::vector<double> values;
  for (const Series& s : chart.series)
    std::copy_if(s.values.begin(), s.values.end(), std::back_inserter(values),
                 [](double v) { return std::isfinite(v) && v >= 0; });
  std::sort(values.begin(), values.end());
  return values;
}

std::vector<double> running_median(const std::vector<double>& values) {
  const std::size_t reach = std::min<std::size_t>(values.size() / 30, 20);
  std::vector<double> result(values.size());
  std::vector<double> window;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t first = i - std::min(i, reach);
    const std::size_t last = std::min(values.size(), i + reach + 1);
    window.assign(values.begin() + static_cast<std::ptrdiff_t>(first),
                  values.begin() + static_cast<std::ptrdiff_t>(last));
    const auto middle = window.begin() + static_cast<std::ptrdiff_t>(window.size() / 2);
    std::nth_element(window.begin(), middle, window.end());
    result[i] = *middle;
  }
  return result;
}

void draw_line(Canvas& canvas, const Rect& plot, const std::vector<double>& values, double top, Colour colour,
               double width, double alpha) {
  cairo_t* const c = canvas.context();
  const double step = plot.width / std::max<double>(1, static_cast<double>(values.size()) - 1);
  bool pen_down = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]) || values[i] < 0) {
      pen_down = false;
      continue;
    }
    const double x = plot.x + step * static_cast<double>(i);
    const double y = plot.y + plot.height * (1 - values[i] / top);
    pen_down ? cairo_line_to(c, x, y) : cairo_move_to(c, x, y);
    pen_down = true;
  }
  canvas.set_colour(colour, alpha);
  cairo_set_line_width(c, width);
  cairo_stroke(c);
}

void draw_mark(Canvas& canvas, double x, double y, Colour colour) {
  cairo_t* const c = canvas.context();
  cairo_move_to(c, x, y - 7);
  cairo_rel_line_to(c, 4, 7);
  cairo_rel_line_to(c, -8, 0);
  cairo_close_path(c);
  canvas.set_colour(colour, 1);
  cairo_fill(c);
}

/// A mark above the plot for each spike that is clipped.
void mark_spikes(Canvas& canvas, const Rect& plot, const Series& series, double top) {
  const double step = plot.width / std::max<double>(1, static_cast<double>(series.values.size()) - 1);
  for (std::size_t i = 0; i < series.values.size(); ++i)
    if (series.values[i] > top) draw_mark(canvas, plot.x + step * static_cast<double>(i), plot.y - 2, series.colour);
}

void draw_axes(Canvas& canvas, const Rect& plot, const Chart& chart, double top) {
  const double y_step = nice_step(top, 5);
  for (double v = 0; v <= top * (1 + 1e-9); v += y_step) {
    const double y = plot.y + plot.height * (1 - v / top);
    canvas.line(plot.x, y, plot.x + plot.width, y, v == 0 ? faint_ink : grid, 1);
    canvas.text(plot.x - 8, y + 4.5, tick_label(v, y_step), 13, faint_ink, Align::right);
  }
  std::size_t count = 0;
  for (const Series& s : chart.series) count = std::max(count, s.values.size());
  if (count < 2) return;
  const double last = chart.x_first + static_cast<double>(count) - 1;
  const double x_step = std::max(1.0, nice_step(static_cast<double>(count), 6));
  for (double v = std::ceil(chart.x_first / x_step) * x_step; v <= last; v += x_step) {
    const double x = plot.x + plot.width * (v - chart.x_first) / (static_cast<double>(count) - 1);
    canvas.line(x, plot.y + plot.height, x, plot.y + plot.height + 4, faint_ink, 1);
    canvas.text(x, plot.y + plot.height + 19, tick_label(v, x_step), 13, faint_ink, Align::centre);
  }
  canvas.text(plot.x + plot.width, plot.y + plot.height + 36, chart.x_label, 13, faint_ink, Align::right);
}

void draw_legend(Canvas& canvas, double x, double y, const Chart& chart) {
  for (const Series& s : chart.series) {
    canvas.line(x, y - 4.5, x + 18, y - 4.5, s.colour, 3);
    canvas.text(x + 26, y, s.name, 14, ink);
    x += 26 + canvas.text_width(s.name, 14) + 26;
  }
}

}  // namespace

Extent y_extent(const Chart& chart) {
  constexpr double room = 1.08, far_beyond = 1.25;
  const std::vector<double> values = sorted_values(chart);
  if (values.empty() || values.back() <= 0) return {1, 0, 0};
  const double usual = values[(values.size() - 1) * 99 / 100], peak = values.back();
  if (values.size() < 50 || usual <= 0 || peak <= far_beyond * usual) return {room * peak, peak, 0};
  const auto above = values.end() - std::upper_bound(values.begin(), values.end(), room * usual);
  return {room * usual, peak, static_cast<std::size_t>(above)};
}

void draw_chart(Canvas& canvas, const Rect& rect, const Chart& chart) {
  canvas.text(rect.x, rect.y + 17, chart.title, 17, ink, Align::left, true);
  draw_legend(canvas, rect.x, rect.y + 44, chart);
  const Rect plot{rect.x + 52, rect.y + 62, rect.width - 60, rect.height - 62 - 42};
  const Extent extent = y_extent(chart);
  draw_axes(canvas, plot, chart, extent.top);
  cairo_t* const c = canvas.context();
  cairo_save(c);
  cairo_rectangle(c, plot.x, plot.y - 2, plot.width, plot.height + 4);
  cairo_clip(c);
  for (const Series& s : chart.series) draw_line(canvas, plot, s.values, extent.top, s.colour, 1, 0.35);
  for (const Series& s : chart.series) draw_line(canvas, plot, running_median(s.values), extent.top, s.colour, 2.4, 1);
  cairo_restore(c);
  if (extent.above == 0) return;
  for (const Series& each : chart.series) mark_spikes(canvas, plot, each, extent.top);
  const double y = plot.y + plot.height + 36, step = nice_step(extent.peak, 20);
  draw_mark(canvas, plot.x + 6, y - 2, faint_ink);
  canvas.text(
      plot.x + 16, y,
      std::to_string(extent.above) + " clipped, up to " + tick_label(std::ceil(extent.peak / step) * step, step), 12,
      faint_ink);
}

}  // namespace boxstream::picture
