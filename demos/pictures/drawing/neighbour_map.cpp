// SPDX-License-Identifier: MIT
#include "neighbour_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "canvas.hpp"

namespace boxstream::picture {
namespace {

using Place = NeighbourMap::Place;

constexpr double width = 1500, height = 760;
constexpr Rect map_area{30, 84, 960, 640}, close_area{1020, 84, 450, 450};
constexpr Colour ink{0.12F, 0.16F, 0.22F}, faint_ink{0.42F, 0.46F, 0.52F}, paper{1, 1, 1}, ground{0.93F, 0.95F, 0.97F},
    low{0.10F, 0.36F, 0.62F}, high{0.45F, 0.70F, 0.88F}, alarm{0.83F, 0.18F, 0.09F};

/// A square part of the plane, or all of it, inside a rectangle of the page, with one scale for both axes.
struct View {
  double x, y;  ///< what is in the middle
  double scale;
  Rect rect;

  double to_x(double at) const { return rect.x + rect.width / 2 + scale * (at - x); }
  double to_y(double at) const { return rect.y + rect.height / 2 - scale * (at - y); }
};

struct Range {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  double middle() const { return least <= most ? least / 2 + most / 2 : 0; }
  double length() const { return least < most ? most - least : 0; }
};

Range range(const std::vector<Place>& places, double Place::*member) {
  Range all;
  for (const Place& place : places) all.add(place.*member);
  return all;
}

View whole(const std::vector<Place>& places, double distance, const Rect& rect) {
  const Range x = range(places, &Place::x), y = range(places, &Place::y);
  const double margin = 2 * distance + 1e-3 * (x.length() + y.length()) + std::numeric_limits<double>::min();
  return {x.middle(), y.middle(), std::min(rect.width / (x.length() + margin), rect.height / (y.length() + margin)),
          rect};
}

View around(const Place& place, double distance, const Rect& rect) {
  const double reach = std::max(distance + 2 * place.radius, std::numeric_limits<double>::min());
  return {place.x, place.y, rect.width / (12 * reach), rect};
}

template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

class Drawing {
 public:
  Drawing(Canvas& canvas, const NeighbourMap& map) : canvas_(canvas), map_(map) {
    heights_ = range(map.places, &Place::z);
    neighbours_.resize(map.places.size());
    for (const auto& [a, b] : map.pairs) {
      ++neighbours_[a];
      ++neighbours_[b];
    }
  }

  void draw() {
    canvas_.fill({0, 0, width, height}, paper);
    canvas_.text_within(width - 60, 30, 38, map_.title, 22, ink, Align::left, true);
    canvas_.text_within(width - 60, 30, 64, map_.subtitle, 15, faint_ink);
    show(whole(map_.places, map_.distance, map_area), 4);
    const auto most = std::max_element(neighbours_.begin(), neighbours_.end());
    if (most == neighbours_.end() || *most == 0) return;
    const auto centre = static_cast<std::size_t>(most - neighbours_.begin());
    show(around(map_.places[centre], map_.distance, close_area), 0);
    canvas_.text_within(close_area.width, close_area.x, close_area.y + close_area.height + 24,
                        text("Number ", centre, " has most neighbours: ", *most), 14, ink);
    canvas_.text_within(close_area.width, close_area.x, close_area.y + close_area.height + 46,
                        text("Around each, half the distance of ", map_.distance), 14, faint_ink);
    if (heights_.length() > 0)
      canvas_.text_within(close_area.width, close_area.x, close_area.y + close_area.height + 68,
                          "Seen from above: the darker, the lower", 14, faint_ink);
  }

 private:
  /// Rings of at least `least_ring` units, so that they are seen on a large map.
  void show(const View& view, double least_ring) {
    canvas_.fill(view.rect, ground, 6);
    cairo_t* const context = canvas_.context();
    cairo_save(context);
    cairo_rectangle(context, view.rect.x, view.rect.y, view.rect.width, view.rect.height);
    cairo_clip(context);
    for (std::size_t i = 0; i < neighbours_.size(); ++i)
      if (neighbours_[i] > 0 || least_ring == 0) {
        const Place& place = map_.places[i];
        const double ring = view.scale * (place.radius + map_.distance / 2);
        circle(view, place, std::max(ring, least_ring), neighbours_[i] > 0 ? alarm : faint_ink, 0.16);
      }
    for (const auto& [i, j] : map_.pairs) {
      const Place &a = map_.places[i], &b = map_.places[j];
      canvas_.line(view.to_x(a.x), view.to_y(a.y), view.to_x(b.x), view.to_y(b.y), alarm, 1);
    }
    for (std::size_t i = 0; i < neighbours_.size(); ++i) {
      const Place& place = map_.places[i];
      circle(view, place, std::max(view.scale * place.radius, least_ring > 0 ? 1.1 : 2.2),
             neighbours_[i] > 0 ? alarm : colour_of(place), 1);
    }
    cairo_restore(context);
  }

  void circle(const View& view, const Place& place, double radius, Colour colour, double alpha) {
    const double x = view.to_x(place.x), y = view.to_y(place.y);
    const Rect& r = view.rect;
    if (x < r.x - radius || x > r.x + r.width + radius || y < r.y - radius || y > r.y + r.height + radius) return;
    canvas_.set_colour(colour, alpha);
    cairo_new_path(canvas_.context());
    cairo_arc(canvas_.context(), x, y, radius, 0, 6.283185307179586);
    cairo_fill(canvas_.context());
  }

  Colour colour_of(const Place& place) const {
    if (heights_.length() == 0) return low;
    const auto t = static_cast<float>((place.z - heights_.least) / heights_.length());
    return {low.r + t * (high.r - low.r), low.g + t * (high.g - low.g), low.b + t * (high.b - low.b)};
  }

  Canvas& canvas_;
  const NeighbourMap& map_;
  Range heights_;
  std::vector<std::size_t> neighbours_;
};

}  // namespace

void write_neighbour_map(const NeighbourMap& map, std::ostream& out, PictureFormat format) {
  write_page(out, format, width, height, [&](Canvas& canvas) { Drawing(canvas, map).draw(); });
}

}  // namespace boxstream::picture
