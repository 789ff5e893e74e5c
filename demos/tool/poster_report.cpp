// SPDX-License-Identifier: MIT
#include "poster_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "machine.hpp"
#include "picture/cut_away.hpp"
#include "picture/render.hpp"
#include "stage.hpp"
#include "summary.hpp"
#include "table.hpp"

namespace boxstream::tool {
namespace {

using picture::Colour;
using picture::Figure;
using picture::Poster;

constexpr Colour colours[] = {{0.11F, 0.45F, 0.73F}, {0.90F, 0.49F, 0.16F}};
constexpr Colour good{0.10F, 0.52F, 0.33F};
constexpr Colour bad{0.78F, 0.14F, 0.16F};

std::string milliseconds(double ms) {
  return fmt::format("{:.3g} ms", ms);
}

double median_of(const WorldRun& world, const Phase& phase) {
  return summarize(times_ms(world.steps, phase)).median_ms;
}

void add_panels(Poster& poster, const RunResult& result) {
  std::vector<std::vector<picture::Drawable>> stages;
  std::vector<picture::Drawable> everything;
  for (const WorldRun& world : result.worlds) {
    stages.push_back(stage(*world.simulation));
    everything.insert(everything.end(), stages.back().begin(), stages.back().end());
  }
  const picture::PanelSize size = picture::panel_size(static_cast<int>(stages.size()));
  const picture::Camera camera =
      picture::frame(everything, static_cast<float>(size.width) / static_cast<float>(size.height));
  for (std::size_t i = 0; i < stages.size(); ++i) {
    picture::cut_away(stages[i], camera);
    poster.panels.push_back({picture::render(stages[i], camera, {size.width, size.height}), result.worlds[i].broadphase,
                             fmt::format("after {} steps", grouped(result.worlds[i].steps.size())), colours[i]});
  }
}

void add_figures(Poster& poster, const RunResult& result) {
  const double a = median_of(result.worlds[0], compared_phase());
  if (!result.is_comparison()) {
    poster.figures = {{milliseconds(a), "broad-phase + dispatch, median step", colours[0]},
                      {milliseconds(median_of(result.worlds[0], phases().back())), "whole step, median"},
                      {grouped(result.worlds[0].steps.back().pairs), "pairs at the end"}};
    return;
  }
  const double b = median_of(result.worlds[1], compared_phase());
  const std::string& name_a = result.worlds[0].broadphase;
  const std::string& name_b = result.worlds[1].broadphase;
  const bool faster = a <= b;
  const double ratio = std::min(a, b) > 0 ? std::max(a, b) / std::min(a, b) : 1;
  poster.figures = {
      {fmt::format("{:.2f} \u00d7", ratio), fmt::format("{} ahead, broad-phase + dispatch", faster ? name_a : name_b),
       colours[faster ? 0 : 1]},
      {fmt::format("{} / {}", milliseconds(a), milliseconds(b)), fmt::format("{} / {}, median step", name_a, name_b)}};
  const std::size_t steps = result.worlds[0].steps.size();
  poster.figures.push_back(
      *result.pairs_equal ? Figure{"pairs equal", fmt::format("in every step: yes ({} steps)", grouped(steps)), good}
                          : Figure{"pairs differ", "see below", bad});
}

void add_charts(Poster& poster, const RunResult& result) {
  picture::Chart times{"Broad-phase + dispatch, ms per step", "step", 1, {}};
  picture::Chart pairs{"Pairs held after each step", "step", 1, {}};
  for (std::size_t i = 0; i < result.worlds.size(); ++i) {
    const WorldRun& world = result.worlds[i];
    times.series.push_back({world.broadphase, colours[i], times_ms(world.steps, compared_phase())});
    std::vector<double> counts;
    for (const scenes::StepResult& s : world.steps) counts.push_back(static_cast<double>(s.pairs));
    pairs.series.push_back({world.broadphase, colours[i], std::move(counts)});
  }
  poster.charts = {std::move(times), std::move(pairs)};
}

}  // namespace

Poster result_poster(const scenes::Scene& scene, const RunResult& result) {
  Poster poster;
  poster.title = scene.meta.name;
  poster.subtitle = scene.meta.about;
  add_panels(poster, result);
  add_figures(poster, result);
  add_charts(poster, result);
  if (!result.first_difference.empty()) poster.small_print.push_back("First difference: " + result.first_difference);
  if (result.is_comparison())
    poster.small_print.push_back(
        "Pairs are compared on the same boxes in every step. The worlds drift apart all the same: the order of pairs "
        "is "
        "the order of contacts in the solver.");
  poster.small_print.push_back(fmt::format(
      "{} objects; boxstream {}, Bullet {}, {}, one thread; thin lines: each step, bold: running median.",
      grouped(result.worlds[0].simulation->census().objects), boxstream_version(), bullet_version(), cpu_name()));
  return poster;
}

}  // namespace boxstream::tool
