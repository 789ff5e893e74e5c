// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "pictures/drawing/plot.hpp"

namespace boxstream::bench {

using picture::Plot;
using picture::PlotLine;

enum class PlotValue { milliseconds, nanoseconds_per_box };

/// The rows of one suite and case, on one thread, in a file that Report wrote. Ours is the first line; configurations
/// of one peer make one line. Throws std::runtime_error when there is nothing to draw or the file is no such file.
Plot read_plot(const std::string& json_path, const std::string& suite, const std::string& case_name, PlotValue value);

}  // namespace boxstream::bench
