// SPDX-License-Identifier: MIT
#include "format/csv.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/output_file.hpp"
#include "measure/machine.hpp"

namespace boxstream::report {
namespace {

/// Shortest text that reads back as the same number; nothing for what does not apply.
std::string number(double value) {
  return std::isnan(value) ? "" : fmt::format("{}", value);
}

std::string text(const std::string& value) {
  if (value.find_first_of(",\"\n") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char c : value) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string origin_lines(const Experiment& experiment, const Results& results, const Origin& origin) {
  const measure::Machine machine = measure::describe_machine();
  std::string out = fmt::format(
      "# experiment: {}\n# title: {}\n# command: {}\n# cost: {}\n# repeats: {}\n# date: {}\n# cpu: {}\n# threads: {}\n"
      "# compiler: {}\n# flags: {}\n# simd: {}\n# version: {}\n# commit: {}\n# load: {:.2f}\n# others: {:.2f}\n",
      experiment.id, experiment.title, origin.command, results.cost_unit, origin.repeats, machine.date, machine.cpu,
      machine.hardware_threads, machine.compiler, machine.flags, machine.simd, machine.version, machine.commit,
      machine.load, origin.others);
  for (const auto& [panel, spread] : results.controls) out += fmt::format("# twins: {}: {:.4f}\n", panel, spread);
  return out;
}

std::string points_table(const Results& results) {
  std::string out = "panel,series,setting,x,cost,cost_low,cost_high,cost_min,instructions";
  for (const std::string& metric : results.metrics) out += "," + text(metric);
  out += ",failure\n";
  for (const Point& point : results.points) {
    if (point.values.size() != results.metrics.size())
      throw std::logic_error("a point has " + std::to_string(point.values.size()) + " values for " +
                             std::to_string(results.metrics.size()) + " metrics");
    out += text(point.panel) + "," + text(point.series) + "," + text(point.setting) + "," + number(point.x);
    for (const double cost : {point.cost.median, point.cost.low, point.cost.high, point.cost.least})
      out += "," + number(cost);
    out += "," + number(point.cost.instructions);
    for (const double value : point.values) out += "," + number(value);
    out += "," + text(point.failure) + "\n";
  }
  return out;
}

/// Curves are only drawn: six digits are enough.
std::string curves_table(const Results& results) {
  std::string out = "panel,series,setting,at,value\n";
  for (const Curve& curve : results.curves)
    for (const auto& [at, value] : curve.points)
      out += text(curve.panel) + "," + text(curve.series) + "," + text(curve.setting) + "," +
             fmt::format("{:.6g},{:.6g}\n", at, value);
  return out;
}

}  // namespace

void write_results(const std::string& directory, const Experiment& experiment, const Results& results,
                   const Origin& origin) {
  const std::filesystem::path base = std::filesystem::path(directory) / experiment.id;
  std::filesystem::create_directories(directory);
  const std::string head = origin_lines(experiment, results, origin);
  const std::string curves = base.string() + ".curves.csv";
  const std::string points = points_table(results);
  if (results.curves.empty())
    std::filesystem::remove(curves);
  else
    files::write_file(curves, head + curves_table(results));
  files::write_file(base.string() + ".csv", head + points);
}

}  // namespace boxstream::report
