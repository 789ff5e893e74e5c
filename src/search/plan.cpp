// SPDX-License-Identifier: MIT
#include "search/plan.hpp"

#include <algorithm>
#include <bit>
#include <iterator>

#include <boxstream/detail/float_environment.hpp>

#include "search/ranked_lows.hpp"

namespace boxstream::detail {

namespace {

// Prices in nanoseconds on one AVX-512 machine. Only their proportions matter, to the choice of a plan and never to its
// result; docs/performance.md has where they come from, and the benchmark's search for the best plan checks them.
constexpr double classify_box = 5.0;   // load one box and find its slabs
constexpr double scatter_copy = 4.0;   // write one 32-byte record to its slab
constexpr double order_copy = 8.0;     // put one box of a leaf into sweep order and pack it
constexpr double look_around = 2.0;    // a box's share of the beginning of its block
constexpr double compare_block = 1.7;  // one box against a block
constexpr double block = 16.0;         // boxes in it
constexpr double window_of_block =
    19.0;  // boxes that a block is compared with whatever their size: itself, and a bucket
constexpr double widest_of_block = 1.4;  // how much farther the widest box of a block reaches than the average
constexpr double make_leaf = 300.0;      // calls, bucket table
constexpr double boxes_in_cache = 1024;  // each doubling of a leaf beyond makes ordering it dearer ...
constexpr double beyond_cache = 0.1;     // ... by this share
constexpr double most_in_leaf = 131072;  // for memory's sake: a leaf takes three times as much a box as a cut does
constexpr double too_large = 4;          // so a larger one has to be so much cheaper

/// What the sample says of one axis.
struct AxisProfile {
  const std::uint64_t* sorted_lows = nullptr;
  double overlap = 0;   // probability that two boxes overlap here
  double crossing = 0;  // probability that a small box crosses a given splitter
  double large = 0;     // share of boxes that span more than half of the slabs
  double stuck = 0;     // share of the largest group of equal low ends, which no split can part
};

AxisProfile profile(const Sample& sample, int axis, Arena& arena) {
  AxisProfile p;
  const std::size_t n = sample.size();
  auto* lows = arena.allocate<std::uint64_t>(n);
  for (std::size_t i = 0; i < n; ++i) lows[i] = ranked(sample.lo(axis)[i], i);
  std::sort(lows, lows + n);
  p.sorted_lows = lows;
  double overlapping = 0;
  std::size_t crossing = 0, large = 0, equal_lows = 1;
  for (std::size_t begin = 0, end = 0; begin < n; begin = end) {
    while (end < n && key_of(lows[end]) == key_of(lows[begin])) ++end;
    equal_lows = std::max(equal_lows, end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      // Each pair once: boxes that begin inside this one, and half of those that begin where it does.
      const std::size_t inside = count_below(lows, n, sample.hi(axis)[position_of(lows[i])], true) - end;
      overlapping += static_cast<double>(inside) + 0.5 * static_cast<double>(end - begin - 1);
      if (inside > n / 2)
        ++large;
      else
        crossing += inside;
    }
  }
  const auto size = static_cast<double>(n);
  p.overlap = std::min(1.0, overlapping / (0.5 * size * (size - 1)) + 0.5 / size);
  p.crossing = static_cast<double>(crossing) / (size * size);
  p.large = static_cast<double>(large) / size;
  p.stuck = static_cast<double>(equal_lows - 1) / size;
  return p;
}

struct Choice {
  double cost;
  int sweep_axis;
  int split_axis;
  int slabs;
  bool children_are_leaves;
  double leaf_size;
};

double sweep_cost(Workload work, double cells, double overlap) {
  const double boxes = std::max(work.boxes, 1.0);
  const double scratch = boxes / cells > most_in_leaf ? too_large : 1;
  const double run = work.candidate_pairs * overlap / boxes;  // boxes that begin within a box on the sweep axis
  const double cache = 1 + beyond_cache * std::bit_width(static_cast<std::uint64_t>(boxes / cells / boxes_in_cache));
  return cells * make_leaf +
         scratch * boxes *
             (order_copy * cache + look_around + compare_block * (window_of_block + widest_of_block * run) / block);
}

/// The work that is left, over all cells, when each of `slabs` slabs gets its boxes and the copies of those that cross.
/// Slabs across the sweep axis save no comparisons, for the sweep would not have made them; they only make leaves fit
/// the cache.
Workload split_work(Workload work, double slabs, const AxisProfile& axis, bool is_sweep_axis) {
  const double share = 1 / slabs + axis.crossing;  // of the boxes, in one slab
  return {work.boxes * slabs * share, work.candidate_pairs * (is_sweep_axis ? 1 : slabs * share * share)};
}

/// Whether low ends differ enough for so many slabs.
bool can_split(const AxisProfile& axis, int slabs) {
  return axis.stuck * slabs <= 1;
}

/// Boxes that span most slabs are taken out and joined with everything apart, without this axis.
double large_cost(Workload work, const AxisProfile& axis, double overlap_elsewhere) {
  if (axis.large == 0) return 0;
  return work.boxes * (classify_box + 2 * scatter_copy + order_copy + look_around) +
         2 * axis.large * work.candidate_pairs * overlap_elsewhere * compare_block / block;
}

constexpr int slab_counts[] = {2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
static_assert(slab_counts[std::size(slab_counts) - 1] == Plan::most_slabs);

// Up to here no cut pays, and further on one is as good as two.
constexpr std::size_t no_level_below = 1024;
constexpr double one_level_below = 8192;

// Prices are not smooth: less than this is no sign that more slabs are dearer.
constexpr double clearly = 1.02;

/// Tries every sweep axis w with every split along u, and every split along another axis v below that. As more slabs
/// first make a plan cheaper and then dearer, the first that is clearly dearer ends a series.
Choice cheapest(const AxisProfile (&axes)[3], Workload work, unsigned blocked) {
  Choice best{1e300, 0, -1, 1, false, work.boxes};
  for (int w = 0; w < 3; ++w) {
    const double overlap = axes[w].overlap;
    const double as_it_is = sweep_cost(work, 1, overlap);
    if (as_it_is < best.cost) best = {as_it_is, w, -1, 1, false, work.boxes};
    for (int u = 0; u < 3 && work.boxes > double{no_level_below}; ++u) {
      if ((blocked >> u & 1) != 0) continue;
      double before_u = 1e300;
      for (const int slabs_u : slab_counts) {
        if (!can_split(axes[u], slabs_u)) break;
        const Workload in_u = split_work(work, slabs_u, axes[u], u == w);
        const double split_u = work.boxes * classify_box + in_u.boxes * scatter_copy;
        const double large_u = large_cost(work, axes[u], u == w ? 1 : overlap);
        const double one_level = split_u + sweep_cost(in_u, slabs_u, overlap) + large_u;
        if (one_level < best.cost) best = {one_level, w, u, slabs_u, true, in_u.boxes / slabs_u};
        double best_of_u = one_level;
        for (int v = 0; v < 3 && work.boxes > one_level_below; ++v) {
          if (v == u || (blocked >> v & 1) != 0) continue;
          double before_v = 1e300;
          for (const int slabs_v : slab_counts) {
            if (!can_split(axes[v], slabs_v)) break;
            const double cells = double(slabs_u) * slabs_v;
            const Workload in_v = split_work(in_u, slabs_v, axes[v], v == w);
            const double share_v = 1.0 / slabs_v + axes[v].crossing;
            const double two_levels = split_u + in_u.boxes * classify_box + in_v.boxes * scatter_copy +
                                      sweep_cost(in_v, cells, overlap) + large_u * share_v +
                                      large_cost(in_u, axes[v], v == w ? 1 : overlap);
            if (two_levels < best.cost) best = {two_levels, w, u, slabs_u, false, in_v.boxes / cells};
            best_of_u = std::min(best_of_u, two_levels);
            if (two_levels > clearly * before_v) break;
            before_v = two_levels;
          }
        }
        if (best_of_u > clearly * before_u) break;
        before_u = best_of_u;
      }
    }
  }
  return best;
}

/// Where the fewest of the sample's pairs overlap.
int least_overlap(const Sample& sample) {
  int best = 0;
  std::uint32_t fewest = UINT32_MAX;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int32_t *const lo = sample.lo(axis), *const hi = sample.hi(axis);
    std::uint32_t overlaps = 0;
    for (std::size_t i = 1; i < sample.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        overlaps += static_cast<std::uint32_t>(lo[i] <= hi[j]) & static_cast<std::uint32_t>(lo[j] <= hi[i]);
    if (overlaps < fewest) best = axis;
    fewest = std::min(fewest, overlaps);
  }
  return best;
}

/// For a node that is not to be cut.
Plan sweep_alone(const Sample& sample) {
  Plan plan;
  plan.sweep.axis = least_overlap(sample);
  const std::int32_t* const lows = sample.lo(plan.sweep.axis);
  const auto [lowest, highest] = std::minmax_element(lows, lows + sample.size());
  plan.sweep.typical_min = *lowest;
  plan.sweep.typical_max = *highest;
  return plan;
}

Choice by_hand(const FixedPlan& plan, int depth) {
  if (depth >= plan.levels) return {0, plan.sweep_axis, -1, 1, false, 0};
  const FixedPlan::Level& level = plan.level[depth];
  return {0, plan.sweep_axis, level.axis, level.slabs, depth + 1 == plan.levels, 1e300};
}

/// Slabs at the quantiles of the sample, as near to them as the buckets allow. Those that would be empty are left out.
void cut(Slabs& slabs, const std::uint64_t* sorted_lows, std::size_t n, int wanted, KeyKind kind) {
  const std::size_t outliers = n / 50;
  slabs.buckets =
      Buckets(kind, key_of(sorted_lows[outliers]), key_of(sorted_lows[n - 1 - outliers]), Slabs::resolution);
  std::uint32_t begin = 0;
  unsigned slab = 0;
  for (int s = 1; s < wanted; ++s) {
    const auto at = n * static_cast<std::size_t>(s) / static_cast<std::size_t>(wanted);
    const std::uint32_t end = slabs.buckets(key_of(sorted_lows[at]));
    if (end == begin) continue;
    std::fill(slabs.of_bucket + begin, slabs.of_bucket + end, static_cast<std::uint8_t>(slab));
    begin = end;
    ++slab;
  }
  std::fill(slabs.of_bucket + begin, slabs.of_bucket + slabs.buckets.count(), static_cast<std::uint8_t>(slab));
  slabs.count = slab + 1;
}

}  // namespace

Sample::Sample(Arena& arena) {
  for (int d = 0; d < 3; ++d) {
    lo_[d] = arena.allocate<std::int32_t>(capacity);
    hi_[d] = arena.allocate<std::int32_t>(capacity);
  }
}

std::size_t Sample::wanted(std::size_t boxes) {
  if (boxes <= no_level_below) return std::clamp<std::size_t>(boxes / 16, 16, 24);  // only for the axis of a sweep
  return boxes < 8192 ? std::clamp<std::size_t>(boxes / 16, 16, 64)
                      : std::clamp<std::size_t>(boxes / 128, 64, capacity);
}

Plan make_plan(const Sample& sample, Workload work, unsigned blocked, int depth, const KeyKind (&kinds)[3],
               Arena& arena) {
  const DefaultFloatEnvironment environment;  // the same plan in every host
  Arena::Frame frame(arena);
  const std::size_t n = sample.size();
  Plan plan;
  if (n < 2) return plan;
  if (work.boxes <= double{no_level_below} && fixed_plan == nullptr) return sweep_alone(sample);
  AxisProfile axes[3];
  for (int d = 0; d < 3; ++d) axes[d] = profile(sample, d, arena);

  const Choice best =
      fixed_plan != nullptr && blocked == 0 ? by_hand(*fixed_plan, depth) : cheapest(axes, work, blocked);
  plan.sweep.axis = best.sweep_axis;
  const std::uint64_t* lows = axes[best.sweep_axis].sorted_lows;
  plan.sweep.typical_min = key_of(lows[n / 50]);
  plan.sweep.typical_max = key_of(lows[n - 1 - n / 50]);
  plan.children_are_leaves = best.children_are_leaves;
  plan.leaf_size = best.leaf_size;
  if (best.split_axis < 0) return plan;

  cut(plan.slabs, axes[best.split_axis].sorted_lows, n, best.slabs, kinds[best.split_axis]);
  if (plan.slabs.count > 1) plan.slabs.axis = best.split_axis;
  return plan;
}

}  // namespace boxstream::detail
