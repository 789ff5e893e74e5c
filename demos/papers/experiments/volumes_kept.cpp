// SPDX-License-Identifier: MIT
// What a traversal that starts from the last one's bottom slice saves, by how far objects move in a frame.
#include <fmt/format.h>

#include <boxstream/detector.hpp>

#include "inputs/batches.hpp"
#include "inputs/random.hpp"
#include "papers/experiments/experiment.hpp"
#include "papers/experiments/measure.hpp"
#include "papers/experiments/rows.hpp"
#include "papers/volumes/axis_box.hpp"
#include "papers/volumes/builders.hpp"
#include "papers/volumes/front.hpp"
#include "papers/volumes/oriented_box.hpp"
#include "papers/volumes/query.hpp"
#include "papers/volumes/sphere.hpp"

namespace boxstream::papers {

namespace {

using namespace volumes;
using Boxes = std::vector<Aabb>;

/// Each box drifts in a direction of its own, by up to `step` of its side a frame and axis.
std::vector<Boxes> drifting(const Boxes& boxes, std::size_t frames, double step, std::uint64_t seed) {
  batches::Random random(seed);
  std::vector<Boxes> motion{boxes};
  std::vector<Point> steps;
  for (const Aabb& box : boxes) {
    Point offset;
    for (int d = 0; d < 3; ++d) offset[d] = random.real(-step, step) * (double{box.max[d]} - double{box.min[d]});
    steps.push_back(offset);
  }
  for (std::size_t frame = 1; frame < frames; ++frame) {
    motion.push_back(boxes);
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (int d = 0; d < 3; ++d) {
        Aabb& box = motion.back()[i];
        const auto offset = static_cast<float>(static_cast<double>(frame) * steps[i][d]);
        box.min[d] += offset;
        box.max[d] += offset;
      }
  }
  return motion;
}

struct Spent {
  Counts counts;
  double ms = 0;
  std::vector<PairSum> found;  ///< frame by frame
};

struct Run {
  Spent fresh, kept, engine;
  double refit_ms = 0;
};

/// The first frame is not counted: in it, the two are the same.
template <Volume V>
Run run(const std::vector<Boxes>& motion, Descent descent) {
  const Objects first = Objects::of(motion[0]);
  Hierarchy<V> hierarchy(build(Builder::surface_area, first), first);
  Front<V> front(hierarchy, hierarchy, descent);
  Run run;
  Detector detector;
  for (std::size_t frame = 0; frame < motion.size(); ++frame) {
    const Boxes& boxes = motion[frame];
    const auto meets = [&](std::uint32_t i, std::uint32_t j) { return overlaps(boxes[i], boxes[j]); };
    const auto spend = [&](Spent& spent, const auto& search) {
      PairSum found;
      Counts counts;
      const double ms = measure::time_once([&] { search(found, counts); });
      spent.found.push_back(found);
      if (frame == 0) return;
      spent.ms += ms;
      spent.counts.volume_tests += counts.volume_tests;
    };
    Counts refits;
    if (frame > 0) run.refit_ms += measure::time_once([&] { hierarchy.refit(Objects::of(boxes), refits); });
    spend(run.fresh, [&](PairSum& found, Counts& counts) {
      traverse(
          hierarchy, hierarchy, descent, meets, [&](auto i, auto j) { found.add(i, j); }, counts);
    });
    spend(run.kept, [&](PairSum& found, Counts& counts) {
      front.step(
          meets, [&](auto i, auto j) { found.add(i, j); }, counts);
    });
    spend(run.engine, [&](PairSum& found, Counts&) {
      detector.stream_pairs(boxes, [&](Span<const Pair> pairs) {
        for (const Pair pair : pairs) found.add(pair.a, pair.b);
        return true;
      });
    });
  }
  return run;
}

}  // namespace

Outcome volumes_kept(const Settings& settings) {
  const std::size_t n = settings.quick ? 200 : 4000, frames = settings.quick ? 4 : 11;
  const Boxes boxes = batches::make("D", n, settings.seed);
  Outcome outcome;
  outcome.table.columns = {
      "volume",   "descent",   "step", "visits from the root", "visits from the slice", "ratio", "refit ms", "root ms",
      "slice ms", "engine ms", "pairs"};
  std::vector<Row> rows;
  for (const double step : {0.001, 0.003, 0.01, 0.03, 0.1}) {
    const std::vector<Boxes> motion = drifting(boxes, frames, step, settings.seed);
    const auto add = [&]<class V>(Descent descent) {
      const std::string below = descent == Descent::both_sides ? "both sides" : "one side";
      const std::string series = fmt::format("{}, {}", V::name(), below);
      settings.progress(fmt::format("step {}, {}", step, series));
      const Run r = run<V>(motion, descent);
      for (std::size_t frame = 0; frame < frames; ++frame) {
        require_same(r.fresh.found[frame], r.engine.found[frame], series + ", from the root");
        require_same(r.kept.found[frame], r.engine.found[frame], series + ", from the slice");
      }
      const double per = static_cast<double>(frames - 1);
      const auto from_root = static_cast<double>(r.fresh.counts.volume_tests) / per;
      const auto from_slice = static_cast<double>(r.kept.counts.volume_tests) / per;
      outcome.table.rows.push_back({V::name(), below, fmt::format("{}", step), fmt::format("{:.0f}", from_root),
                                    fmt::format("{:.0f}", from_slice), fmt::format("{:.3f}", from_slice / from_root),
                                    fmt::format("{:.2f}", r.refit_ms / per), fmt::format("{:.2f}", r.fresh.ms / per),
                                    fmt::format("{:.2f}", r.kept.ms / per), fmt::format("{:.2f}", r.engine.ms / per),
                                    std::to_string(r.engine.found.back().pairs)});
      rows.push_back({series, n, step, from_slice / from_root, r.engine.found.back().pairs});
    };
    for (const Descent descent : {Descent::both_sides, Descent::one_side}) {
      add.template operator()<AxisBox>(descent);
      add.template operator()<Sphere>(descent);
      add.template operator()<OrientedBox>(descent);
    }
  }
  picture::Plot plot = plot_of(rows, fmt::format("Visits from the bottom slice, {} boxes that drift", n),
                               "motion in a frame, sides of a box", "of those from the root");
  plot.y = picture::Axis::linear;
  outcome.plots.push_back(plot);
  return outcome;
}

}  // namespace boxstream::papers
