// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "accuracy/sweep.hpp"
#include "boxstream/accuracy/accuracy_result.hpp"
#include "boxstream/shared/print.hpp"
#include "pictures/drawing/plot.hpp"

namespace boxstream::tool {

/// A row for each setting, a column for each knob, each measure (worst, p95, mean, last) and the times.
std::string accuracy_csv(const AccuracyResult& result);

std::string accuracy_json(const AccuracyResult& result);

/// Work against precision, of one measure: its bound, the band within which the reference cannot tell errors apart,
/// and of each line its name, its order of convergence, and what the bound costs on it.
nlohmann::ordered_json precision_json(const AccuracyResult& result, std::size_t measure);

/// For reading; ends in a newline.
std::string accuracy_table(const AccuracyResult& result);

/// Time against what settings are judged by, of which there is one: a line for each combination of all knobs but the
/// last, with the bound and the reference's band across.
picture::Plot accuracy_plot(const AccuracyResult& result);

/// Throws BadInput unless the page can be made: `name` ends in .html, the viewer is built in, and there are two
/// settings.
void check_view(const std::string& name, const accuracy::Request& request);

/// Runs the scene with the first and with the last setting, and writes a page that plays both side by side. Throws as
/// accuracy::run and view::Recording.
void write_accuracy_view(const accuracy::Request& request, std::ostream& out, StatusLine& status);

/// Whether pages can be made: only if Node.js bundled them when the tool was built.
bool has_accuracy_page();

/// What the page draws, as JSON: the scene as its only experiment. `picture`: a PNG of the scene in base64, or empty.
std::string accuracy_page_json(const AccuracyResult& result, const std::string& picture);

/// The page of a sweep, one HTML file for any browser: plots, tables, and which setting keeps the bounds that one
/// types. Throws as scenes::Simulation's constructor and picture::render do.
void write_accuracy_page(const AccuracyResult& result, std::ostream& out);

}  // namespace boxstream::tool
