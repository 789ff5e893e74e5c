// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/near.hpp>
#include <functional>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace boxstream::tool {

/// Reads rows of numbers, separated by blanks or commas. Empty lines and what follows a '#' are skipped; "inf" and
/// "-inf" are numbers. A first row without any number names the columns and is skipped; `names` gets them, without
/// quotes; one name alone, or words between blanks of which one has more than two letters, may be a title. `take` is
/// given the numbers of each row and returns why they are refused, or nothing. Throws BadInput "NAME:LINE: reason" for
/// that, for anything else in a row, for a NaN, for more than `most` of them and for another number of them than of
/// names, for an empty field between two commas, for lines of more than 65536 characters and for more than 50 million
/// lines. `number` is that of the first line.
void read_number_rows(std::istream& in, const std::string& name, std::size_t most,
                      const std::function<std::string(const std::vector<double>&)>& take, std::size_t number = 1,
                      std::vector<std::string>* names = nullptr);

/// Reads one box a line: "minx miny minz maxx maxy maxz", separated and skipped as `read_number_rows` says. Throws
/// BadInput "NAME:LINE: reason" for anything else, for a NaN, for min > max and for columns whose names are those of
/// minima and maxima in another order.
std::vector<Aabb64> read_boxes(std::istream& in, const std::string& name, std::size_t first_line = 1);

struct Balls {
  std::vector<Ball64> all;
  int dimensions;  ///< 2: all z are 0
};

/// Reads one point, disk or ball a line: "x y", "x y z" or "x y z radius", all rows alike; with `dimensions` 2, "x y"
/// or "x y radius". What separates them, and what is skipped, is as `read_number_rows` says. Throws BadInput
/// "NAME:LINE: reason" for anything else, for a column of radii that has another name, for a coordinate that is called
/// as an index or a time is, for what is not finite and for a radius below 0.
Balls read_balls(std::istream& in, const std::string& name, std::optional<int> dimensions);

}  // namespace boxstream::tool
