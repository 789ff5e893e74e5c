// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "tables/plot.hpp"
#include "tables/results_table.hpp"

namespace boxstream::bench {

namespace {

/// "cgal:300" is one of the configurations of "cgal".
std::string family_of(const std::string& peer) {
  return peer.substr(0, peer.find(':'));
}

/// One colour a library: its members are distinguished by their labels.
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
  if (known == line->points.end())
    line->points.push_back({n, value});
  else
    known->y = std::min(known->y, value);
}

/// Of the peers, in their order.
void keep(const std::vector<NamedPeer>& peers, std::vector<PlotLine>& lines) {
  std::vector<PlotLine> kept = {lines.front()};
  for (const NamedPeer& peer : peers) {
    const auto line = std::find_if(lines.begin(), lines.end(), [&](const PlotLine& l) { return l.name == peer.name; });
    if (line == lines.end()) throw std::runtime_error("there are no rows of " + peer.name);
    kept.push_back(*line);
    kept.back().name = peer.words;
    kept.back().colour.reset();
  }
  lines = std::move(kept);
}

}  // namespace

Plot read_plot(const std::string& json_path, const std::string& suite, const std::string& case_name, PlotValue value,
               const std::vector<NamedPeer>& peers, std::size_t most) {
  const ResultsFile results = read_results(json_path);
  Plot plot;
  plot.lines.push_back({"boxstream", true, {}});
  for (const Row& row : results.rows) {
    if (row.suite != suite || row.case_name != case_name || row.threads != 1 || row.n > most) continue;
    const auto n = static_cast<double>(row.n);
    const auto scaled = [&](double ms) { return value == PlotValue::milliseconds ? ms : 1e6 * ms / n; };
    add_point(plot, "boxstream", n, scaled(row.ours_ms));
    if (row.skipped.empty()) add_point(plot, family_of(row.peer), n, scaled(row.peer_ms));
  }
  if (!peers.empty()) keep(peers, plot.lines);
  if (plot.lines.size() < 2)
    throw std::runtime_error(fmt::format("{} has no rows of suite {}, case {}", json_path, suite, case_name));
  for (PlotLine& line : plot.lines)
    std::sort(line.points.begin(), line.points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  const Machine& machine = results.machine;
  plot.small_print = fmt::format("{}, {}, {}, one thread, {}", machine.cpu, machine.compiler, machine.simd,
                                 machine.date.substr(0, 10));
  plot.unit = value == PlotValue::milliseconds ? "milliseconds" : "nanoseconds a box";
  plot.title = fmt::format("All pairs of n boxes: suite {}, case {}", suite, case_name);
  return plot;
}

}  // namespace boxstream::bench
