// SPDX-License-Identifier: MIT
#include "papers/experiments/rows.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace boxstream::papers {

Table table_of(const std::vector<Row>& rows, const std::string& x_name, const std::string& value_name) {
  Table table{{"series", "n", x_name, value_name, "pairs"}, {}};
  for (const Row& row : rows)
    table.rows.push_back({row.series, std::to_string(row.n), fmt::format("{}", row.x), fmt::format("{:.4g}", row.value),
                          std::to_string(row.pairs)});
  return table;
}

picture::Plot plot_of(const std::vector<Row>& rows, const std::string& title, const std::string& x_label,
                      const std::string& unit) {
  picture::Plot plot;
  plot.title = title;
  plot.x_label = x_label;
  plot.unit = unit;
  for (const Row& row : rows) {
    auto line = std::find_if(plot.lines.begin(), plot.lines.end(), [&](const auto& l) { return l.name == row.series; });
    if (line == plot.lines.end()) {
      line = plot.lines.insert(line, {row.series, row.series == engine_name, {}});
      if (row.series.rfind(engine_name, 0) == 0) line->colour = picture::our_colour;
    }
    line->points.push_back({row.x, row.value});
  }
  return plot;
}

Outcome outcome_of(const std::vector<Row>& rows, const std::string& x_name, const std::string& title,
                   const std::string& x_label, std::vector<std::string> findings) {
  return {table_of(rows, x_name, "ms"), {plot_of(rows, title, x_label, "milliseconds")}, std::move(findings)};
}

}  // namespace boxstream::papers
