// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string>

#include "boxstream/accuracy/accuracy_result.hpp"

namespace boxstream::tool {

/// Whether pages can be made: only if Node.js bundled them when the tool was built.
bool has_accuracy_page();

/// What the page draws, as JSON: the scene as its only experiment. `picture`: a PNG of the scene in base64, or empty.
std::string accuracy_page_json(const AccuracyResult& result, const std::string& picture);

/// The page of a sweep, one HTML file for any browser: plots, tables, and which setting keeps the bounds that one
/// types. Throws as scenes::Simulation's constructor and picture::render do.
void write_accuracy_page(const AccuracyResult& result, std::ostream& out);

}  // namespace boxstream::tool
