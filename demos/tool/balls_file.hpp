// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/near.hpp>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace boxstream::tool {

struct Balls {
  std::vector<Ball64> all;
  int dimensions;  ///< 2: all z are 0
};

/// Reads one point, disk or ball a line: "x y", "x y z" or "x y z radius", all rows alike; with `dimensions` 2, "x y"
/// or "x y radius". What separates them, and what is skipped, is as `read_number_rows` says. Throws BadInput
/// "NAME:LINE: reason" for anything else, for what is not finite and for a radius below 0.
Balls read_balls(std::istream& in, const std::string& name, std::optional<int> dimensions);

}  // namespace boxstream::tool
