// SPDX-License-Identifier: MIT

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "boxstream/accuracy/accuracy_writers.hpp"
#include "boxstream/shared/report.hpp"
#include "boxstream/simulate/drawables.hpp"
#include "formats/scene_model/scene.hpp"
#include "measure/machine.hpp"
#include "pictures/drawing/png_file.hpp"
#include "pictures/drawing/render.hpp"
#include "pictures/drawing/set_dressing.hpp"
#include "pictures/viewer/shell.hpp"
#include "pictures/viewer/text.hpp"

namespace boxstream::tool {
namespace {

using nlohmann::ordered_json;

constexpr int picture_steps = 30, picture_width = 240, picture_height = 120;

/// JSON has no number for what is not finite.
ordered_json number(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

/// The setting without its last knob, which the page shows as a series.
std::string series_of(const accuracy::Request& request, const accuracy::Setting& setting) {
  const accuracy::Setting but_last(setting.begin(), setting.end() - 1);
  return but_last.empty() ? "" : accuracy::label(request.knobs, but_last);
}

/// A row of the page's table, with the measures at `columns`; data.js says what is where.
ordered_json row_of(const AccuracyResult& result, const std::vector<std::size_t>& columns, const accuracy::Row& row) {
  ordered_json values = ordered_json::array();
  for (const std::size_t m : columns) values.push_back(number(row.series[m].of(result.request.measures[m])));
  const nlohmann::json& last = row.setting.back();
  return {result.sweep.scene.name,
          series_of(result.request, row.setting),
          accuracy::text_of(result.request.knobs.back(), last),
          last.is_number() ? ordered_json(last) : ordered_json(nullptr),
          number(row.ms.median),
          number(row.ms.low),
          number(row.ms.high),
          nullptr,
          nullptr,
          values,
          row.failure.empty() && !row.unsound.empty() ? "not sound: " + row.unsound : row.failure};
}

const char* name_of(accuracy::Better better) {
  return better == accuracy::Better::high ? "high" : better == accuracy::Better::near_zero ? "zero" : "low";
}

/// Of each row [error, low, high]; of what is better when larger the value itself.
ordered_json errors_of(const AccuracyResult& result, std::size_t measure) {
  ordered_json all = ordered_json::array();
  const bool turned = better(result.request.measures[measure]) == accuracy::Better::high;
  for (std::size_t i = 0; i < result.sweep.rows.size(); ++i) {
    const accuracy::ErrorInterval error = accuracy::error_interval(result.request, result.sweep, i, measure);
    const double value = turned ? -error.value : error.value;
    all.push_back({number(value), number(turned ? value : error.low), number(turned ? value : error.high)});
  }
  return all;
}

/// Of each metric work against precision.
ordered_json plots_of(const AccuracyResult& result) {
  ordered_json plots = ordered_json::array();
  for (const std::size_t m : applicable(result)) {
    const accuracy::Measure& measure = result.request.measures[m];
    ordered_json plot{{"kind", "precision"},
                      {"y", measure.name},
                      {"better", name_of(better(measure))},
                      {"off", has_own_error(result, m)},
                      {"errors", errors_of(result, m)},
                      {"front", accuracy::front_of(result.request, result.sweep, m)}};
    plot.update(precision_json(result, m));
    plots.push_back(std::move(plot));
  }
  return plots;
}

/// The place of the setting to take among the points.
ordered_json take_of(const AccuracyResult& result) {
  const auto best = advised(result);
  return best ? ordered_json(*best) : ordered_json(nullptr);
}

ordered_json table_of(const AccuracyResult& result) {
  const std::vector<std::size_t> columns = applicable(result);
  ordered_json metrics = ordered_json::array(), points = ordered_json::array();
  for (const std::size_t m : columns) metrics.push_back(result.request.measures[m].name);
  for (const accuracy::Row& row : result.sweep.rows) points.push_back(row_of(result, columns, row));
  return {{"facts",
           {{"cost", "ms per simulated second"},
            {"command", result.page_command},
            {"cpu", cpu_name()},
            {"compiler", compiler_name()},
            {"version", measure::library_version()},
            {"date", measure::describe_machine().date},
            {"repeats", std::to_string(result.request.repeats)}}},
          {"controls",
           ordered_json::array({ordered_json::array({result.sweep.scene.name, number(result.sweep.control_spread)})})},
          {"metrics", metrics},
          {"points", points}};
}

/// What the others are compared with: the scene as it is, or the setting that was measured first.
ordered_json default_of(const AccuracyResult& result) {
  const accuracy::Setting& setting = result.sweep.rows.at(result.sweep.own.value_or(0)).setting;
  return {{"series", series_of(result.request, setting)},
          {"setting", accuracy::text_of(result.request.knobs.back(), setting.back())},
          {"own", result.sweep.own.has_value()}};
}

ordered_json notes_of(const AccuracyResult& result) {
  ordered_json all = ordered_json::array();
  for (const auto& [metric, text] : notes(result)) all.push_back({{"metric", metric}, {"text", text}});
  return all;
}

std::string lead_of(const AccuracyResult& result) {
  const std::string& about = result.sweep.scene.about;
  if (!result.request.settling) return about;
  return about + " Measured after " + std::to_string(result.request.settling->steps) + " steps to come to rest.";
}

/// The scene a moment after its start, as a PNG in base64.
std::string picture_of(const accuracy::Request& request) {
  scenes::Simulation simulation(accuracy::scene_with(request, {}), request.broadphase);
  while (simulation.steps_done() < picture_steps) simulation.advance();
  std::vector<picture::Drawable> things = drawables(simulation);
  const picture::Camera camera = picture::frame(things, static_cast<float>(picture_width) / picture_height);
  picture::cut_away(things, camera);
  picture::add_floor(things);
  std::ostringstream png;
  picture::write_png(picture::render(things, camera, {picture_width, picture_height, 64}), png);
  return view::base64(png.str());
}

}  // namespace

bool has_accuracy_page() {
  return !view::accuracy_shell().empty();
}

std::string accuracy_page_json(const AccuracyResult& result, const std::string& picture) {
  const std::string& scene = result.sweep.scene.name;
  const ordered_json experiment{
      {"id", "scene"},
      {"title", scene},
      {"question", "What do its settings cost, and what do they buy?"},
      {"plots", plots_of(result)},
      {"knobs", {{"", result.request.knobs.back().name}, {scene, result.request.knobs.back().name}}},
      {"default", default_of(result)},
      {"take", take_of(result)},
      {"findings", findings(result)},
      {"notes", notes_of(result)},
      {"table", table_of(result)}};
  ordered_json document{{"kind", "scene"},
                        {"title", "What accuracy costs in time: " + scene},
                        {"lead", lead_of(result)},
                        {"names", ordered_json::object()},
                        {"pictures", ordered_json::object()},
                        {"experiments", ordered_json::array({experiment})}};
  if (!picture.empty()) document["pictures"][scene] = "data:image/png;base64," + picture;
  return document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void write_accuracy_page(const AccuracyResult& result, std::ostream& out) {
  const std::string_view page = view::accuracy_shell();
  const std::size_t mark = page.find(view::accuracy_mark);
  out << page.substr(0, mark);
  // "<" could end the element that the JSON is in.
  for (const char c : accuracy_page_json(result, picture_of(result.request))) {
    if (c == '<')
      out << "\\u003c";
    else
      out << c;
  }
  out << page.substr(mark + view::accuracy_mark.size());
}

}  // namespace boxstream::tool
