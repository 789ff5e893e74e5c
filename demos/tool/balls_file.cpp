// SPDX-License-Identifier: MIT
#include "balls_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "number_rows.hpp"

namespace boxstream::tool {

Balls read_balls(std::istream& in, const std::string& name, std::optional<int> dimensions) {
  Balls balls{{}, dimensions.value_or(0)};
  std::size_t columns = 0;
  read_number_rows(in, name, 4, [&](const std::vector<double>& row) -> std::string {
    if (columns == 0) {
      columns = row.size();
      if (!dimensions) balls.dimensions = columns == 2 ? 2 : 3;
      const auto least = static_cast<std::size_t>(balls.dimensions);
      if (columns < std::max<std::size_t>(2, least) || columns > least + 1)
        return fmt::format("{} numbers, expected {} or {}", columns, std::max<std::size_t>(2, least), least + 1);
    }
    if (row.size() != columns) return fmt::format("{} numbers, {} in the rows before", row.size(), columns);
    for (const double value : row)
      if (!std::isfinite(value)) return "an infinity is no place";
    const auto d = static_cast<std::size_t>(balls.dimensions);
    const double radius = columns > d ? row[d] : 0;
    if (radius < 0) return "a radius below 0";
    balls.all.push_back({{row[0], row[1], d == 3 ? row[2] : 0}, radius});
    return {};
  });
  if (balls.dimensions == 0) balls.dimensions = 3;
  return balls;
}

}  // namespace boxstream::tool
