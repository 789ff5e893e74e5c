// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "canvas.hpp"

namespace boxstream::picture {

/// Writes what `draw` draws on a page of that size, as SVG or, with two pixels a unit, PNG, by the ending of `path`.
/// Throws std::runtime_error.
void write_page(const std::string& path, double width, double height, const std::function<void(Canvas&)>& draw);

}  // namespace boxstream::picture
