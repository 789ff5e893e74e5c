// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace boxstream::tool {

/// Text for reading, to standard output: only line breaks steer the terminal. Throws std::runtime_error if not all of
/// it could be written.
void print(const std::string& text);

/// The same of text for programs, as it is.
void print_raw(const std::string& text);

/// Help, likewise; on a terminal that shows colours its headings are bold.
void print_help(const std::string& text);

/// The same to standard error, "boxstream: " in front, on one line; never throws.
void remark(const std::string& text) noexcept;

/// remark() of what went wrong: its beginning is red on a terminal that shows colours.
void complain(const std::string& text) noexcept;

}  // namespace boxstream::tool
