// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "pictures/drawing/plot.hpp"

namespace boxstream::bench {

using picture::Plot;
using picture::PlotLine;

enum class PlotValue { milliseconds, nanoseconds_per_box };

/// A peer by its name in the rows, and what the picture calls it.
struct NamedPeer {
  std::string name, words;
};

/// The rows of one suite and case, on one thread, in a file that Report wrote. Ours is the first line; of the
/// configurations of a peer the fastest counts. Of `peers` alone, in their words, unless there are none; up to `most`
/// boxes. Throws std::runtime_error when there is nothing to draw or the file is no such file.
Plot read_plot(const std::string& json_path, const std::string& suite, const std::string& case_name, PlotValue value,
               const std::vector<NamedPeer>& peers = {}, std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace boxstream::bench
