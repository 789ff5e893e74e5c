// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "drawable.hpp"
#include "poster.hpp"

namespace boxstream::picture {

/// The colour of boxstream's lines, where there are others beside the bold one.
inline constexpr Colour our_colour{0.83F, 0.18F, 0.09F};

/// Values of one contestant.
struct PlotLine {
  struct Point {
    double x, y;             ///< above 0 on a logarithmic axis
    std::string label = {};  ///< written beside it
    bool failed = false;     ///< a cross at the upper edge, whatever y is
  };
  std::string name;
  bool ours = false;                            ///< drawn bold, above all others
  std::vector<Point> points;                    ///< at least one, by x
  std::optional<Colour> colour = std::nullopt;  ///< none: by its place among those that have none
};

enum class Axis { logarithmic, linear };

struct Plot {
  std::string title;
  std::string small_print;
  std::string unit;  ///< of the values
  std::vector<PlotLine> lines;
  std::string x_label = "n, boxes";
  Axis x = Axis::logarithmic, y = Axis::logarithmic;  ///< a linear axis begins at 0; values must not be below
  bool dark = false;                                  ///< for pages that are dark
};

/// Throws std::runtime_error.
void write_plot(const Plot& plot, std::ostream& out, PictureFormat format);
/// The format is that of the ending of `path`, and the file appears whole or not at all.
void write_plot(const Plot& plot, const std::string& path);

}  // namespace boxstream::picture
