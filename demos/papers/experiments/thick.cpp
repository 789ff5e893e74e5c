// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "inputs/random.hpp"
#include "inputs/traffic.hpp"
#include "papers/experiments/disks.hpp"
#include "papers/experiments/experiment.hpp"
#include "papers/experiments/rows.hpp"
#include "papers/thick/report_intersections.hpp"

namespace boxstream::papers {

namespace {

using Sizes = std::vector<std::size_t>;

/// Measures the contestants on one input, a row each.
std::vector<Measured> compete(const Settings& settings, std::size_t n, double x,
                              const std::vector<Contestant>& contestants, std::vector<Row>& rows) {
  settings.progress(fmt::format("n = {}, {:.3g}", n, x));
  const std::vector<Measured> measured = measure_interleaved(settings.repeats, contestants);
  for (std::size_t c = 0; c < contestants.size(); ++c)
    rows.push_back({contestants[c].name, n, x, measured[c].ms, measured[c].found.pairs});
  return measured;
}

struct Item {
  Ball ball;
  std::uint32_t number;
};

/// Hoare's algorithm with a random pivot, down to single items, by the first coordinate: the yardstick of section 3.
void quicksort(Item* first, Item* last, batches::Random& random) {
  while (last - first > 1) {
    const float pivot = first[random.integer(0, last - first - 1)].ball.centre[0];
    Item *low = first, *high = last - 1;
    while (low <= high) {
      while (low->ball.centre[0] < pivot) ++low;
      while (high->ball.centre[0] > pivot) --high;
      if (low <= high) std::swap(*low++, *high--);
    }
    quicksort(first, high + 1, random);
    first = low;
  }
}

/// Median time to sort what the algorithm sorts, checked.
double quicksort_ms(int repeats, const std::vector<Ball>& balls) {
  std::vector<Item> items;
  const auto fill = [&] {
    items.clear();
    for (const Ball& ball : balls) items.push_back({ball, static_cast<std::uint32_t>(items.size())});
  };
  const double ms = measure_time(repeats, fill, [&] {
    batches::Random random(1);
    quicksort(items.data(), items.data() + items.size(), random);
  });
  if (!std::is_sorted(items.begin(), items.end(),
                      [](const Item& a, const Item& b) { return a.ball.centre[0] < b.ball.centre[0]; }))
    throw std::runtime_error("quicksort does not sort");
  return ms;
}

/// The disks, known by a point anywhere in them.
struct Held {
  Ball ball;
  float x, y;
};

Outcome thick_sort(const Settings& settings) {
  const Sizes sizes = settings.quick ? Sizes{1000, 5000} : Sizes{10'000, 30'000, 100'000, 300'000, 1'000'000};
  std::vector<Row> rows;
  std::vector<std::string> findings;
  for (const std::size_t n : sizes) {
    const auto x = static_cast<double>(n);
    const std::vector<Ball> balls = make_balls(n, 2, x / 2, 1, settings.seed);
    const auto m = compete(settings, n, x, {thick(balls, 2), thick_at_random(balls, 2), engine(balls)}, rows);
    const double sorting = quicksort_ms(settings.repeats, balls);
    rows.push_back({"quicksort", n, x, sorting, 0});
    findings.push_back(
        fmt::format("n = {}, {} pairs: thick takes {:.2f} times as long as quicksort, {:.2f} with random pivots; "
                    "boxstream {:.2f}",
                    n, m[0].found.pairs, m[0].ms / sorting, m[1].ms / sorting, m[2].ms / sorting));
  }
  return outcome_of(rows, "disks", "Thick objects: disks of one radius, half as many pairs as disks", "n, disks",
                    findings);
}

Outcome thick_naive(const Settings& settings) {
  const std::size_t n = settings.quick ? 300 : 3000;
  const double all = static_cast<double>(n) * static_cast<double>(n - 1) / 2;
  std::vector<Row> rows;
  std::vector<std::string> findings;
  // The last one makes disks that are larger than the square.
  for (const double share : {1e-4, 1e-3, 1e-2, 1e-1, 1.0, 10.0}) {
    const std::vector<Ball> balls = make_balls(n, 2, share * all, 1, settings.seed);
    std::vector<Row> own;
    const auto m = compete(settings, n, share, {naive(balls), thick(balls, 2), engine(balls)}, own);
    const double found = static_cast<double>(m[0].found.pairs);
    for (Row row : own) {
      row.x = std::max(found, 1.0);
      rows.push_back(row);
    }
    findings.push_back(fmt::format("{:.3g} % of all pairs: thick takes {:.3g} times as long as naive, boxstream {:.3g}",
                                   100 * found / all, m[1].ms / m[0].ms, m[2].ms / m[0].ms));
  }
  return outcome_of(rows, "pairs found", fmt::format("Thick objects: {} disks, all against all", n),
                    "k, intersecting pairs", findings);
}

Outcome thick_pairs(const Settings& settings) {
  const std::size_t n = settings.quick ? 1000 : 100'000;
  std::vector<Row> rows;
  for (const double each : {0.01, 0.1, 1.0, 10.0, 100.0}) {
    const std::vector<Ball> balls = make_balls(n, 2, each * static_cast<double>(n), 1, settings.seed);
    batches::Random random(settings.seed);
    std::vector<Held> held;
    for (const Ball& ball : balls) {
      const double reach = 0.7 * static_cast<double>(ball.radius);  // of a square inside the disk
      const auto near = [&](float centre) {
        return static_cast<float>(static_cast<double>(centre) + random.real(-reach, reach));
      };
      const float x = near(ball.centre[0]);
      held.push_back({ball, x, near(ball.centre[1])});
    }
    const Contestant anywhere{"thick, points anywhere in the disks", [&](Found found) {
                                // What a disk of this diameter has in single precision can stand out of it by an ulp.
                                const float diameter = 2.0001F * balls[0].radius;
                                report_intersections<2>(
                                    Span<const Held>(held), diameter,
                                    [](const Held& h, std::size_t d) { return d == 0 ? h.x : h.y; },
                                    [](const Held& a, const Held& b) { return is_near(a.ball, b.ball, 0.0F); }, found);
                              }};
    compete(settings, n, each, {thick(balls, 2), anywhere, engine(balls)}, rows);
  }
  return outcome_of(rows, "pairs a disk", fmt::format("Thick objects: {} disks of one radius", n),
                    "k / n, intersecting pairs for each disk");
}

Outcome thick_space(const Settings& settings) {
  const Sizes sizes = settings.quick ? Sizes{1000, 3000} : Sizes{10'000, 30'000, 100'000, 300'000};
  std::vector<Row> rows;
  for (const std::size_t n : sizes) {
    const auto x = static_cast<double>(n);
    const std::vector<Ball> balls = make_balls(n, 3, x / 2, 1, settings.seed);
    compete(settings, n, x, {thick(balls, 3), engine(balls)}, rows);
  }
  return outcome_of(rows, "balls", "Thick objects: balls in space of one radius, half as many pairs as balls",
                    "n, balls");
}

Outcome thick_radii(const Settings& settings) {
  const std::size_t n = settings.quick ? 1000 : 100'000, fewer = settings.quick ? 1000 : 30'000;
  std::vector<Row> rows;
  for (const double factor : {1.0, 4.0, 16.0, 64.0}) {
    const std::vector<Ball> many = make_balls(n, 2, static_cast<double>(n) / 2, factor, settings.seed);
    compete(settings, n, factor, {thick(many, 2), engine(many)}, rows);
    // What the paper calls its main weakness: one large disk makes the reach of all.
    std::vector<Ball> one = make_balls(fewer, 2, static_cast<double>(fewer) / 2, 1, settings.seed);
    one[0].radius *= static_cast<float>(factor);
    std::vector<Contestant> contestants{thick(one, 2), engine(one)};
    for (Contestant& contestant : contestants) contestant.name += ", one large disk";
    compete(settings, fewer, factor, contestants, rows);
  }
  return outcome_of(rows, "largest / smallest radius",
                    fmt::format("Thick objects: {} disks of many radii; {} and one large one", n, fewer),
                    "largest / smallest radius");
}

Outcome thick_traffic(const Settings& settings) {
  const std::size_t n = settings.quick ? 1000 : 100'000;
  std::vector<Row> rows;
  std::vector<std::string> findings;
  for (const char* const name : {"air", "sea"}) {
    const batches::Traffic traffic = batches::make_traffic(name, n, settings.seed);
    std::vector<Ball> balls;
    for (const Ball64& ball : traffic.objects)
      balls.push_back(
          {{static_cast<float>(ball.centre[0]), static_cast<float>(ball.centre[1]), static_cast<float>(ball.centre[2])},
           static_cast<float>(ball.radius)});
    for (const double share : {0.25, 0.5, 1.0, 2.0}) {
      const auto distance = static_cast<float>(share * traffic.safety_distance);
      std::vector<Contestant> contestants{thick(balls, traffic.dimensions, distance), engine(balls, distance)};
      for (Contestant& contestant : contestants) contestant.name += fmt::format(", {}", name);
      const auto m = compete(settings, n, share, contestants, rows);
      if (share == 1)
        findings.push_back(fmt::format("{} {}, {} pairs within {}: thick takes {:.2f} times as long as boxstream", n,
                                       traffic.what, m[0].found.pairs, traffic.safety_distance, m[0].ms / m[1].ms));
    }
  }
  return outcome_of(rows, "distance / usual distance", fmt::format("Traffic: {} aircraft and ships", n),
                    "safety distance / the usual one", findings);
}

}  // namespace

Span<const Experiment> thick_experiments() {
  static constexpr Experiment all[] = {
      {"sort", "Disks in the plane against quicksort", thick_sort},
      {"naive", "Disks in the plane against all pairs", thick_naive},
      {"pairs", "From few pairs to many, and reference points that are not centres", thick_pairs},
      {"radii", "Radii within a factor", thick_radii},
      {"space", "Balls in space", thick_space},
      {"traffic", "Safety distances in air and sea traffic", thick_traffic},
  };
  return all;
}

}  // namespace boxstream::papers
