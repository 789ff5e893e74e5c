// SPDX-License-Identifier: MIT
#include "truth.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "knob.hpp"

namespace boxstream::accuracy {
namespace {

std::vector<std::string_view> cells_of(std::string_view line) {
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    std::string_view cell = line.substr(0, comma);
    while (!cell.empty() && cell.front() == ' ') cell.remove_prefix(1);
    while (!cell.empty() && cell.back() == ' ') cell.remove_suffix(1);
    cells.push_back(cell);
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

double number_of(std::string_view cell, const std::string& where) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
    throw BadKnob(where + ": not a number: '" + std::string(cell) + "'");
  return value;
}

}  // namespace

std::vector<Truth::Point> read_truth(std::istream& file, const std::string& name) {
  constexpr std::string_view wanted[] = {"seconds", "x", "y", "z"};
  std::string line;
  std::getline(file, line);
  if (line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
  const auto header = cells_of(line);
  std::size_t column[4];
  for (int i = 0; i < 4; ++i) {
    const auto found = std::find(header.begin(), header.end(), wanted[i]);
    if (found == header.end())
      throw BadKnob(name + ": the first line names no column \"" + std::string(wanted[i]) + "\" (seconds,x,y,z)");
    column[i] = static_cast<std::size_t>(found - header.begin());
  }
  std::vector<Truth::Point> points;
  for (std::size_t number = 2; std::getline(file, line); ++number) {
    if (line.empty() || line == "\r") continue;
    const std::string where = name + ":" + std::to_string(number);
    const auto cells = cells_of(line);
    double values[4];
    for (int i = 0; i < 4; ++i) {
      if (column[i] >= cells.size()) throw BadKnob(where + ": too few columns");
      values[i] = number_of(cells[column[i]], where);
    }
    if (values[0] < 0 || (!points.empty() && values[0] <= points.back().seconds))
      throw BadKnob(where + ": times must be 0 or later, and grow");
    points.push_back({values[0], {values[1], values[2], values[3]}});
  }
  if (points.empty()) throw BadKnob(name + ": no line of numbers");
  return points;
}

}  // namespace boxstream::accuracy
