// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drawable.hpp"
#include "png_file.hpp"

namespace boxstream::picture {

/// What the colours of a still mean: from the first at `low` to the last at `high`, which have their unit.
struct ColourBar {
  std::string title;
  std::string low, high;
  std::vector<Colour> colours;  ///< evenly spaced; none: no bar
};

/// A still with a heading.
struct Panel {
  Image image;
  std::string label;
  std::string note;
  Colour accent;
  ColourBar bar{};
};

/// A headline number: "2.4 x" over "faster than dbvt".
struct Figure {
  std::string value;
  std::string caption;
  Colour colour{0.12F, 0.16F, 0.22F};
};

struct Series {
  std::string name;
  Colour colour;
  std::vector<double> values;
};

/// Values over consecutive whole numbers (steps), drawn thin, with their running median drawn bold.
struct Chart {
  std::string title;
  std::string x_label;
  int x_first = 1;
  /// Values are >= 0; others are left out of the line.
  std::vector<Series> series;
};

/// One page: title, stills side by side, headline numbers, charts side by side, small print.
struct Poster {
  std::string title;
  std::string subtitle;
  std::vector<Panel> panels;
  std::vector<Figure> figures;
  std::vector<Chart> charts;
  std::vector<std::string> small_print;
};

enum class PictureFormat { png, svg };

/// By the ending of `path`, in any case; nothing for any other ending.
std::optional<PictureFormat> picture_format(std::string_view path);

struct PanelSize {
  int width;
  int height;
};
/// The size in pixels to render the stills of a poster with `count` (>= 1) panels in.
PanelSize panel_size(int count);

/// Width of every poster in pixels; the height follows from what is on it.
inline constexpr int poster_width = 1600;

/// In SVG, text and charts stay vectors and the stills are embedded. Throws std::runtime_error; whether all was written
/// `out` knows.
void write_poster(const Poster& poster, std::ostream& out, PictureFormat format);

}  // namespace boxstream::picture
