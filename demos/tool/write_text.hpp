// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace boxstream::tool {

/// Both throw std::runtime_error if not all of `text` could be written.
void write_text(const std::string& path, const std::string& text);
/// To standard output.
void print(const std::string& text);

}  // namespace boxstream::tool
