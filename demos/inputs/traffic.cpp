// SPDX-License-Identifier: MIT
#include "inputs/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "inputs/random.hpp"

namespace boxstream::batches {
namespace {

struct Point {
  double x, y;
};

/// Part of the world, three wide to two high, with a few places that its routes lead to.
struct Region {
  Point corner;
  double width, height;
  std::vector<Point> places;

  Point anywhere(Random& random) const {
    const double x = corner.x + random.real(0, width);
    return {x, corner.y + random.real(0, height)};
  }

  /// Of a few spots, the one with most room.
  Point far_from_places(Random& random) const {
    Point best{};
    double best_room = -1;
    for (int i = 0; i < 8; ++i) {
      const Point spot = anywhere(random);
      double room = width * width;
      for (const Point& place : places) {
        const double x = place.x - spot.x, y = place.y - spot.y;
        room = std::min(room, x * x + y * y);
      }
      if (room > best_room) {
        best = spot;
        best_room = room;
      }
    }
    return best;
  }

  /// Some places are busier than others: the first ones.
  std::size_t busy_place(Random& random) const {
    const double u = random.unit();
    return static_cast<std::size_t>(u * u * static_cast<double>(places.size()));
  }
};

struct Leg {
  Point from, to;
  double length;
  Point direction;

  Leg(const Region& region, Random& random) {
    const std::size_t a = region.busy_place(random);
    std::size_t b = region.busy_place(random);
    if (a == b) b = (b + 1) % region.places.size();
    from = region.places[a];
    to = region.places[b];
    const double x = to.x - from.x, y = to.y - from.y;
    length = std::sqrt(x * x + y * y);
    // Two places at one spot are possible, if not likely.
    direction = length > 0 ? Point{x / length, y / length} : Point{1, 0};
  }

  /// So far along, and so far to the right.
  Point at(double along, double right) const {
    return {from.x + direction.x * along + direction.y * right, from.y + direction.y * along - direction.x * right};
  }
};

double rounded(double miles) {
  return std::round(1000 * miles) / 1000;
}

constexpr double miles_a_thousand_feet = 5;

Ball64 aircraft(const Region& region, Random& random) {
  constexpr double climb = 90, descent = 110;  // miles
  const Leg leg(region, random);
  const double along = random.real(0, leg.length);
  const Point place = leg.at(along, 1.5 * random.gaussian());
  const double level = static_cast<double>(2 * random.integer(14, 19) + (leg.direction.x > 0 ? 1 : 0));
  const double reached = std::min({1.0, along / climb, (leg.length - along) / descent});
  const double thousand_feet = level * reached + 0.05 * random.gaussian();
  return {{rounded(place.x), rounded(place.y), rounded(miles_a_thousand_feet * std::max(0.0, thousand_feet))}, 0};
}

Ball64 ship(const Region& region, Random& random) {
  constexpr double metres_a_mile = 1852, shortest = 15, longest_to_shortest = 400.0 / 15;
  const double half_length = shortest * random.log_uniform(longest_to_shortest) / 2;
  const double kind = random.unit();
  Point place{};
  if (kind < 0.2) {  // fishing
    place = region.anywhere(random);
  } else if (kind < 0.4) {  // at anchor
    const Point port = region.places[region.busy_place(random)];
    place.x = port.x + 5 * random.gaussian();
    place.y = port.y + 5 * random.gaussian();
  } else {
    const Leg leg(region, random);
    const double along = random.real(0, leg.length);
    place = leg.at(along, 2 + 0.7 * random.gaussian());
  }
  return {{rounded(place.x), rounded(place.y), 0}, rounded(half_length / metres_a_mile)};
}

/// Regions side by side, each for at most 2000 objects, with `area` for each of these, and `places` if it is full.
std::vector<Region> make_regions(std::size_t n, double area, std::size_t places, Random& random) {
  const std::size_t count = std::max<std::size_t>(1, (n + 1999) / 2000);
  places = std::max<std::size_t>(4, places * n / (2000 * count));
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  const double height = std::sqrt(area * static_cast<double>(n) / static_cast<double>(count) / 1.5);
  std::vector<Region> regions(count);
  for (std::size_t i = 0; i < count; ++i) {
    Region& region = regions[i];
    region.width = 1.5 * height;
    region.height = height;
    region.corner = {static_cast<double>(i % columns) * region.width, static_cast<double>(i / columns) * height};
    while (region.places.size() < places) region.places.push_back(region.far_from_places(random));
  }
  return regions;
}

std::vector<Ball64> fill(const std::vector<Region>& regions, std::size_t n, Ball64 (*make)(const Region&, Random&),
                         Random& random) {
  std::vector<Ball64> objects;
  objects.reserve(n);
  for (std::size_t i = 0; i < n; ++i) objects.push_back(make(regions[i % regions.size()], random));
  return objects;
}

}  // namespace

Traffic make_traffic(std::string_view name, std::size_t n, std::uint64_t seed) {
  Random random(seed);
  if (name == "air") return {fill(make_regions(n, 600, 20, random), n, aircraft, random), 3, 5, "aircraft"};
  if (name == "sea") return {fill(make_regions(n, 100, 14, random), n, ship, random), 2, 0.5, "ships"};
  throw std::invalid_argument("no traffic '" + std::string(name) + "'; there are air, sea");
}

}  // namespace boxstream::batches
