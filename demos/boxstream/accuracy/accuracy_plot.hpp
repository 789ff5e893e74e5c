// SPDX-License-Identifier: MIT
#pragma once

#include "boxstream/accuracy/accuracy_result.hpp"
#include "pictures/drawing/plot.hpp"

namespace boxstream::tool {

/// Time against what settings are judged by, of which there is one: a line for each combination of all knobs but the
/// last, with the bound and the reference's band across.
picture::Plot accuracy_plot(const AccuracyResult& result);

}  // namespace boxstream::tool
