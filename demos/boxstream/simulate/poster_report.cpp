// SPDX-License-Identifier: MIT
#include "boxstream/simulate/reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "boxstream/shared/print.hpp"
#include "boxstream/shared/report.hpp"
#include "boxstream/simulate/drawables.hpp"
#include "boxstream/simulate/summary.hpp"
#include "pictures/drawing/render.hpp"
#include "pictures/drawing/set_dressing.hpp"

namespace boxstream::tool {
namespace {

using picture::Colour;
using picture::Figure;
using picture::Poster;

constexpr Colour colours[] = {{0.11F, 0.45F, 0.73F}, {0.90F, 0.49F, 0.16F}};
constexpr Colour good{0.10F, 0.52F, 0.33F};
constexpr Colour bad{0.78F, 0.14F, 0.16F};

std::string short_time(double ms) {
  return ms < 1000 ? fmt::format("{:.3g} ms", ms) : fmt::format("{:.3g} s", ms / 1000);
}

double total_of(const WorldRun& world, const Phase& phase) {
  return summarize(times_ms(world.steps, phase)).total_ms;
}

double median_of(const WorldRun& world, const Phase& phase) {
  return summarize(times_ms(world.steps, phase)).median_ms;
}

void add_panels(Poster& poster, const RunResult& result) {
  std::vector<std::vector<picture::Drawable>> drawn;
  std::vector<picture::Drawable> everything;
  for (const WorldRun& world : result.worlds) {
    drawn.push_back(drawables(*world.simulation));
    everything.insert(everything.end(), drawn.back().begin(), drawn.back().end());
  }
  const picture::PanelSize size = picture::panel_size(static_cast<int>(drawn.size()));
  const picture::Camera camera =
      picture::frame(everything, static_cast<float>(size.width) / static_cast<float>(size.height));
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    picture::cut_away(drawn[i], camera);
    picture::add_floor(drawn[i]);
    poster.panels.push_back({picture::render(drawn[i], camera, {size.width, size.height}), result.worlds[i].broadphase,
                             fmt::format("after {} steps", grouped(result.worlds[i].steps.size())), colours[i],
                             creation_bar(*result.worlds[i].simulation)});
  }
}

/// How two worlds compare in one phase, over the whole run: the headline number and, below, what it is made of.
Figure ratio_figure(const RunResult& result, const Phase& phase, const std::string& what) {
  const double a = total_of(result.worlds[0], phase);
  const double b = total_of(result.worlds[1], phase);
  const std::size_t winner = a <= b ? 0 : 1;
  const double ratio = std::min(a, b) > 0 ? std::max(a, b) / std::min(a, b) : 1;
  return {fmt::format("{} {:.2f} \u00d7 faster", result.worlds[winner].broadphase, ratio),
          fmt::format("{}: {} {}, {} {}", what, result.worlds[winner].broadphase, short_time(std::min(a, b)),
                      result.worlds[1 - winner].broadphase, short_time(std::max(a, b))),
          colours[winner]};
}

void add_figures(Poster& poster, const RunResult& result) {
  const WorldRun& first = result.worlds[0];
  if (!result.is_comparison()) {
    poster.figures = {{short_time(median_of(first, phases().front())), "broad-phase, median step", colours[0]},
                      {short_time(median_of(first, phases().back())), "whole step, median"},
                      {grouped(first.steps.back().pairs), "pairs at the end"}};
    return;
  }
  const std::string steps = grouped(first.steps.size());
  poster.figures = {ratio_figure(result, phases().front(), "broad-phase"),
                    ratio_figure(result, phases().back(), "whole steps"),
                    *result.pairs_equal ? Figure{"pairs equal", "in every step: yes (" + steps + " steps)", good}
                                        : Figure{"pairs differ", "the first difference is given below", bad}};
}

picture::Chart chart_of(const RunResult& result, const std::string& title,
                        const std::function<double(const scenes::StepResult&)>& value) {
  picture::Chart chart{title, "step", 1, {}};
  for (std::size_t i = 0; i < result.worlds.size(); ++i) {
    const std::vector<scenes::StepResult>& steps = result.worlds[i].steps;
    std::vector<double> values(steps.size());
    std::transform(steps.begin(), steps.end(), values.begin(), value);
    chart.series.push_back({result.worlds[i].broadphase, colours[i], std::move(values)});
  }
  return chart;
}

bool holds_fatter_boxes(const RunResult& result) {
  const auto is_dbvt = [](const WorldRun& world) { return world.broadphase == "dbvt"; };
  return result.is_comparison() && std::count_if(result.worlds.begin(), result.worlds.end(), is_dbvt) == 1;
}

}  // namespace

Poster result_poster(const scenes::Scene& scene, const RunResult& result) {
  Poster poster;
  poster.title = scene.meta.name;
  poster.subtitle = scene.meta.about;
  add_panels(poster, result);
  add_figures(poster, result);
  poster.charts = {
      chart_of(result, "Broad-phase, ms per step", phases().front().time_ms),
      chart_of(result, "Whole step, ms", phases().back().time_ms),
      chart_of(result, "Pairs held", [](const scenes::StepResult& s) { return static_cast<double>(s.pairs); })};
  if (!result.first_difference.empty()) poster.small_print.push_back("First difference: " + result.first_difference);
  if (result.is_comparison())
    poster.small_print.push_back(
        "Large figures: sums over all steps. Pairs are compared on the same boxes in every step; the worlds drift "
        "apart, because the order of pairs is the order of contacts in the solver.");
  if (holds_fatter_boxes(result))
    poster.small_print.push_back(
        "dbvt holds more pairs, because its boxes are fatter: Bullet grows them by 0.05 and ahead of motion.");
  poster.small_print.push_back(
      fmt::format("{} objects; boxstream {}, Bullet {}, {}, one thread; thin lines: each step, bold: running median.",
                  grouped(result.worlds[0].simulation->census().objects), measure::library_version(), bullet_version(),
                  cpu_name()));
  return poster;
}

}  // namespace boxstream::tool
