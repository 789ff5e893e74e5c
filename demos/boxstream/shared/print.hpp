// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace boxstream::tool {

/// Text for reading, to standard output: only line breaks steer the terminal. Throws std::runtime_error if not all of
/// it could be written.
void print(const std::string& text);

/// The same to standard error, "boxstream: " in front, on one line; never throws.
void remark(const std::string& text) noexcept;

}  // namespace boxstream::tool
