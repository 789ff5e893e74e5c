// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <istream>
#include <string>
#include <vector>

namespace boxstream::tool {

/// Reads rows of numbers, separated by blanks or commas. Empty lines and what follows a '#' are skipped; "inf" and
/// "-inf" are numbers. `take` is given the numbers of each row and returns why they are refused, or nothing.
/// Throws BadInput "NAME:LINE: reason" for that, for anything else in a row, for a NaN, and for more than `most` of
/// them.
void read_number_rows(std::istream& in, const std::string& name, std::size_t most,
                      const std::function<std::string(const std::vector<double>&)>& take);

/// All of a file, or of standard input for "-". Throws BadInput if it cannot be read.
std::string read_whole(const std::string& path);

}  // namespace boxstream::tool
