// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace boxstream::bench {

/// Time over n of ours or of one peer.
struct PlotLine {
  struct Point {
    double n, value;
  };
  std::string name;
  bool ours = false;
  std::vector<Point> points;  // by n
};

struct Plot {
  std::string title;
  std::string small_print;
  std::string unit;  ///< of the values
  std::vector<PlotLine> lines;
};

enum class PlotValue { milliseconds, nanoseconds_per_box };

/// The rows of one suite and case, on one thread, in a file that Report wrote. Ours is the first line; configurations
/// of one peer make one line. Throws std::runtime_error when there is nothing to draw or the file is no such file.
Plot read_plot(const std::string& json_path, const std::string& suite, const std::string& case_name, PlotValue value);

/// Log-log, as SVG or PNG by the ending of `path`. Throws std::runtime_error.
void write_plot(const Plot& plot, const std::string& path);

}  // namespace boxstream::bench
