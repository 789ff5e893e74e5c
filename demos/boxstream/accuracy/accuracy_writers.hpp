// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "boxstream/accuracy/accuracy_result.hpp"
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

}  // namespace boxstream::tool
