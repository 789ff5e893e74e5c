// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/aabb.hpp>
#include <istream>
#include <string>
#include <vector>

namespace boxstream::tool {

/// Reads one box a line: "minx miny minz maxx maxy maxz", separated and skipped as `read_number_rows` says. Throws
/// BadInput "NAME:LINE: reason" for anything else, for a NaN and for min > max.
std::vector<Aabb64> read_boxes(std::istream& in, const std::string& name, std::size_t first_line = 1);

}  // namespace boxstream::tool
