// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace boxstream {

/// "; did you mean 'NAME'?" with the one of `names` that is the fewest slips of a finger away from `given`, or that
/// begins with it; nothing if all are too far.
std::string did_you_mean(const std::string& given, const std::vector<std::string>& names);

/// "unknown NOUN 'GIVEN'", then the nearest of `names`, or, if none is near, all of them.
std::string unknown_word(const std::string& noun, const std::string& given, const std::vector<std::string>& names);

}  // namespace boxstream

namespace boxstream::files {

/// `text` as it may go to a terminal, on one line: control characters, marks that turn the direction of writing, and
/// bytes that are no UTF-8 become \xNN. All else stays as it is.
std::string printable(std::string_view text);

/// The same for text of several lines, whose line breaks stay.
std::string printable_lines(std::string_view text);

}  // namespace boxstream::files
