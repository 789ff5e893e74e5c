// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "plot.hpp"

namespace boxstream::bench {

namespace {

/// "cgal:300" is one of the configurations of "cgal".
std::string family_of(const std::string& peer) {
  return peer.substr(0, peer.find(':'));
}

/// One colour a library: its members are told apart by their labels.
picture::Colour colour_of(const std::string& peer) {
  const auto begins = [&](const char* prefix) { return peer.rfind(prefix, 0) == 0; };
  if (begins("cgal")) return {0.10F, 0.44F, 0.70F};
  if (begins("fcl-")) return {0.25F, 0.58F, 0.30F};
  if (begins("dbvt") || begins("axis")) return {0.55F, 0.35F, 0.68F};
  return {0.50F, 0.50F, 0.50F};
}

void add_point(Plot& plot, const std::string& name, double n, double value) {
  auto line = std::find_if(plot.lines.begin(), plot.lines.end(), [&](const PlotLine& l) { return l.name == name; });
  if (line == plot.lines.end()) line = plot.lines.insert(line, {name, false, {}, colour_of(name)});
  const auto known = std::find_if(line->points.begin(), line->points.end(), [&](const auto& p) { return p.x == n; });
  if (known == line->points.end()) line->points.push_back({n, value});
}

}  // namespace

Plot read_plot(const std::string& json_path, const std::string& suite, const std::string& case_name, PlotValue value) {
  std::ifstream file(json_path);
  if (!file) throw std::runtime_error("cannot read " + json_path);
  Plot plot;
  plot.lines.push_back({"boxstream", true, {}});
  try {
    const nlohmann::json document = nlohmann::json::parse(file);
    for (const nlohmann::json& row : document.at("rows")) {
      if (row.at("suite") != suite || row.at("case") != case_name || row.at("threads") != 1) continue;
      const double n = row.at("n");
      const auto scaled = [&](double ms) { return value == PlotValue::milliseconds ? ms : 1e6 * ms / n; };
      add_point(plot, "boxstream", n, scaled(row.at("ours_ms")));
      if (row.contains("peer_ms")) add_point(plot, family_of(row.at("peer")), n, scaled(row.at("peer_ms")));
    }
    const nlohmann::json& machine = document.at("machine");
    plot.small_print = fmt::format("{}, {}, {}, one thread, {}", machine.at("cpu").get<std::string>(),
                                   machine.at("compiler").get<std::string>(), machine.at("simd").get<std::string>(),
                                   machine.at("date").get<std::string>().substr(0, 10));
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(fmt::format("{} is not a file of benchmark rows: {}", json_path, error.what()));
  }
  if (plot.lines.size() < 2)
    throw std::runtime_error(fmt::format("{} has no rows of suite {}, case {}", json_path, suite, case_name));
  for (PlotLine& line : plot.lines)
    std::sort(line.points.begin(), line.points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  plot.unit = value == PlotValue::milliseconds ? "milliseconds" : "nanoseconds a box";
  plot.title = fmt::format("All pairs of n boxes: suite {}, case {}", suite, case_name);
  return plot;
}

}  // namespace boxstream::bench
