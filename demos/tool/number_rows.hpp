// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <istream>
#include <string>
#include <vector>

namespace boxstream::tool {

/// Reads rows of numbers, separated by blanks or commas. Empty lines and what follows a '#' are skipped; "inf" and
/// "-inf" are numbers. A first row without any number names the columns and is skipped. `take` is given the numbers of
/// each row and returns why they are refused, or nothing. Throws BadInput "NAME:LINE: reason" for that, for anything
/// else in a row, for a NaN, and for more than `most` of them, for lines of more than 65536 characters and for more
/// than 50 million lines. `number` is that of the first line.
void read_number_rows(std::istream& in, const std::string& name, std::size_t most,
                      const std::function<std::string(const std::vector<double>&)>& take, std::size_t number = 1);

}  // namespace boxstream::tool
