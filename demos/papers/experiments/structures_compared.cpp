// SPDX-License-Identifier: MIT
// The experiments of `boxstream paper structures`: what each kind of work costs with each structure that can do it.
#include <algorithm>
#include <bit>
#include <limits>

#include "inputs/batches.hpp"
#include "inputs/random.hpp"
#include "papers/experiments/comparison.hpp"
#include "papers/experiments/workload.hpp"

namespace boxstream::papers {

namespace {

using Boxes = std::vector<Aabb>;

struct Set {
  std::string batch;
  std::size_t n;
};

/// The first batch at several sizes, for the plot.
std::vector<Set> sets_of(const Settings& settings) {
  if (settings.quick) return {{"D", 300}, {"D", 1000}, {"R", 300}};
  return {{"D", 500},     {"D", 2000},   {"D", 8000},   {"D", 32'000}, {"U", 32'000},
          {"M2", 32'000}, {"C", 32'000}, {"P", 32'000}, {"R", 32'000}};
}

std::size_t queries_of(const Settings& settings) {
  return settings.quick ? 50 : 1000;
}

Boxes boxes_of(const Set& set, const Settings& settings) {
  return batches::make(set.batch, set.n, settings.seed);
}

PairSum ask_boxes(const Structure& structure, const Boxes& queries) {
  PairSum found;
  for (std::uint32_t i = 0; i < queries.size(); ++i)
    structure.query_box(queries[i], [&](std::uint32_t number) { found.add(number, i); });
  return found;
}

PairSum ask_rays(const Structure& structure, const std::vector<Ray>& rays) {
  PairSum found;
  for (const Ray& ray : rays) {
    const FirstHit hit = structure.first_hit(ray);
    if (hit.number != FirstHit::none) found.add(hit.number, std::bit_cast<std::uint32_t>(hit.enter));
  }
  return found;
}

/// What was built must answer as the engine does, as far as it has such queries.
Outcome build(const Settings& settings) {
  Comparison comparison(settings, "Building", "ns per box", 1e6);
  for (const Set& set : sets_of(settings)) {
    const Boxes boxes = boxes_of(set, settings), queries = queries_about(boxes, 30, settings.seed);
    const std::vector<Ray> rays = rays_through(boxes, 30, settings.seed);
    const auto engine = structures()[0].make();
    engine->build(boxes);
    const PairSum by_boxes = ask_boxes(*engine, queries), by_rays = ask_rays(*engine, rays);
    comparison.add({set.batch, set.n, box_work | ray_work | point_work, static_cast<double>(set.n), nullptr, nullptr,
                    [&](Structure& structure) {
                      structure.build(boxes);
                      return PairSum{};
                    },
                    [&](Structure& structure, unsigned works) {
                      if ((works & box_work) != 0) require_same(ask_boxes(structure, queries), by_boxes, "one built");
                      if ((works & ray_work) != 0) require_same(ask_rays(structure, rays), by_rays, "one built");
                    },
                    no_build});
  }
  return comparison.outcome();
}

Outcome query_boxes(const Settings& settings, const char* title, unsigned works, bool as_points) {
  Comparison comparison(settings, title, "us per query", 1e3);
  for (const Set& set : sets_of(settings)) {
    const Boxes boxes = boxes_of(set, settings), queries = queries_about(boxes, queries_of(settings), settings.seed);
    const Boxes asked = as_points ? centres(boxes) : boxes;
    comparison.add({set.batch, set.n, works, static_cast<double>(queries.size()),
                    [&](Structure& structure) { structure.build(asked); }, nullptr,
                    [&](Structure& structure) { return ask_boxes(structure, queries); }});
  }
  return comparison.outcome();
}

Outcome points(const Settings& settings) {
  return query_boxes(settings, "Points in a box", box_work | point_work, true);
}

Outcome boxes(const Settings& settings) {
  return query_boxes(settings, "Boxes that touch a box", box_work, false);
}

Outcome rays(const Settings& settings) {
  Comparison comparison(settings, "First box on a ray", "us per ray", 1e3);
  for (const Set& set : sets_of(settings)) {
    const Boxes boxes = boxes_of(set, settings);
    const std::vector<Ray> shot = rays_through(boxes, queries_of(settings), settings.seed);
    comparison.add({set.batch, set.n, ray_work, static_cast<double>(shot.size()),
                    [&](Structure& structure) { structure.build(boxes); }, nullptr,
                    [&](Structure& structure) { return ask_rays(structure, shot); }});
  }
  return comparison.outcome();
}

/// One box out, another in, and a query.
Outcome updates(const Settings& settings) {
  Comparison comparison(settings, "One box out, one in, one query", "us per round", 1e3);
  for (const Set& set : sets_of(settings)) {
    const Boxes all = boxes_of({set.batch, 2 * set.n}, settings);
    const auto half = all.begin() + static_cast<std::ptrdiff_t>(set.n);
    const Boxes first(all.begin(), half), second(half, all.end());
    const std::size_t rounds = std::min<std::size_t>(set.n, settings.quick ? 100 : 4000);
    const Boxes queries = queries_about(first, rounds, settings.seed);
    std::vector<std::uint32_t> order(set.n);
    for (std::uint32_t i = 0; i < set.n; ++i) order[i] = i;
    batches::Random(settings.seed).shuffle(order);
    comparison.add({set.batch, set.n, update_work, static_cast<double>(rounds), nullptr,
                    [&](Structure& structure) { structure.build(first); },
                    [&](Structure& structure) {
                      PairSum found;
                      for (std::uint32_t i = 0; i < rounds; ++i) {
                        structure.erase(order[i]);
                        structure.insert(static_cast<std::uint32_t>(set.n) + i, second[i]);
                        structure.query_box(queries[i], [&](std::uint32_t number) { found.add(number, i); });
                      }
                      return found;
                    }});
  }
  return comparison.outcome();
}

/// The slowest of n insertions into what was empty, each with a query, because some put off what they have to do until
/// then. The least of several runs: all else is the machine's doing.
Outcome longest(const Settings& settings) {
  Comparison comparison(settings, "The longest of n insertions", "ms", 1);
  for (const Set& set : sets_of(settings)) {
    if (set.batch != sets_of(settings).front().batch) continue;
    const Boxes boxes = boxes_of(set, settings), queries = queries_about(boxes, set.n, settings.seed);
    PairSum expected;
    for (const StructureEntry& entry : structures()) {
      if ((entry.works & update_work) == 0) continue;
      double least = std::numeric_limits<double>::infinity();
      for (int run = 0; run < settings.repeats; ++run) {
        settings.progress(set.batch + ", " + std::string(entry.name));
        const auto structure = entry.make();
        structure->build({});
        PairSum found;
        double slowest = 0;
        for (std::uint32_t i = 0; i < set.n; ++i) {
          slowest = std::max(slowest, measure::time_once([&] {
                               structure->insert(i, boxes[i]);
                               structure->query_box(queries[i], [&](std::uint32_t number) { found.add(number, i); });
                             }));
        }
        if (&entry == &structures()[0]) expected = found;
        require_same(found, expected, std::string(entry.name));
        least = std::min(least, slowest);
      }
      comparison.add(std::string(entry.name), set.batch, set.n, least, expected.pairs);
    }
  }
  return comparison.outcome();
}

/// From boxes to the last pair: all that has to be built is built within the time.
Outcome pairs(const Settings& settings) {
  Comparison comparison(settings, "All pairs of two sets", "ns per box", 1e6);
  for (const Set& set : sets_of(settings)) {
    const Boxes all = boxes_of(set, settings);
    const auto half = all.begin() + static_cast<std::ptrdiff_t>(set.n / 2);
    const Boxes a(all.begin(), half), b(half, all.end());
    comparison.add(
        {set.batch, set.n, pair_work, static_cast<double>(set.n), nullptr, nullptr, [&](Structure& structure) {
           PairSum found;
           structure.build(a);
           structure.find_pairs(b, [&](std::uint32_t i, std::uint32_t j) { found.add(i, j); });
           return found;
         }});
  }
  return comparison.outcome();
}

/// Boxes that move up to a tenth of their side in a frame: all of them, or one in twenty.
Outcome frames(const Settings& settings) {
  Comparison comparison(settings, "All pairs, frame after frame", "ns per box and frame", 1e6);
  for (const double share : {1.0, 0.05})
    for (const Set& set : sets_of(settings)) {
      // Without continuing from the last frame, rods take longer than all the others together.
      if (set.batch == "R" && !settings.quick) continue;
      const Boxes boxes = boxes_of(set, settings);
      const auto motion = frames_of(boxes, settings.quick ? 3 : 4, share, settings.seed);
      const std::string name = set.batch + (share < 1 ? ", 1 in 20 moves" : ", all move");
      comparison.add({name, set.n, frame_work, static_cast<double>(set.n * motion.size()), nullptr,
                      [&](Structure& structure) {
                        structure.build(boxes);
                        structure.next_frame(boxes, [](std::uint32_t, std::uint32_t) {});
                      },
                      [&](Structure& structure) {
                        PairSum found;
                        std::uint32_t frame = 0;
                        for (const Boxes& now : motion) {
                          structure.next_frame(now, [&](std::uint32_t i, std::uint32_t j) { found.add(i, j + frame); });
                          frame += 0x1000000;
                        }
                        return found;
                      }});
    }
  return comparison.outcome();
}

}  // namespace

Span<const Experiment> structure_experiments() {
  static constexpr Experiment all[] = {
      {"build", "Building", build},
      {"points", "Points in a box", points},
      {"boxes", "Boxes that touch a box", boxes},
      {"rays", "First box on a ray", rays},
      {"updates", "One box out, one in, one query", updates},
      {"longest", "The longest of n insertions, each with a query", longest},
      {"pairs", "All pairs of two sets, from the boxes on", pairs},
      {"frames", "All pairs, frame after frame", frames},
      {"tightness", "Bounding volumes around a sphere, level by level", volumes_tight},
      {"volumes", "Bounding volume hierarchies: every builder with every volume", volumes_at_work},
      {"slice", "Traversal from the bottom slice of the last one", volumes_kept},
  };
  return all;
}

}  // namespace boxstream::papers
