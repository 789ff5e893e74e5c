// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace boxstream::files {

/// `text` as it may go to a terminal, on one line: control characters, marks that turn the direction of writing, and
/// bytes that are no UTF-8 become \xNN. All else stays as it is.
std::string printable(std::string_view text);

/// The same for text of several lines, whose line breaks stay.
std::string printable_lines(std::string_view text);

}  // namespace boxstream::files
