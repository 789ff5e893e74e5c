// SPDX-License-Identifier: MIT
#include "plan.hpp"

#include <algorithm>
#include <cfenv>

#include "ranked_lows.hpp"

namespace boxstream::detail {

namespace {

// Rough prices in nanoseconds on one AVX-512 machine, estimated from whole searches and not yet measured one by one.
// Only their proportions matter, to the choice of a plan and never to its result.
constexpr double classify_box = 3.0;    // find the slabs of one box
constexpr double scatter_copy = 4.0;    // write one 32-byte record to its slab
constexpr double order_copy = 14.0;     // put one box of a leaf into sweep order
constexpr double start_run = 4.0;       // begin the run of one box
constexpr double compare_lanes = 1.5;   // one wide comparison
constexpr double lanes = 16.0;          // boxes in it
constexpr double same_bucket = 6.0;     // comparisons a run wastes in its first and last bucket
constexpr double make_leaf = 200.0;     // calls, bucket table
constexpr double boxes_in_cache = 6e4;  // a leaf of so many boxes takes twice as long a box as a small one

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

/// The caller's rounding mode, traps and flushing must not show in the plan, nor the plan in the caller's flags.
class DefaultFloatEnvironment {
 public:
  DefaultFloatEnvironment() {
    std::fegetenv(&caller_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatEnvironment() { std::fesetenv(&caller_); }
  DefaultFloatEnvironment(const DefaultFloatEnvironment&) = delete;
  DefaultFloatEnvironment& operator=(const DefaultFloatEnvironment&) = delete;

 private:
  std::fenv_t caller_;
};

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
  const double run = work.candidate_pairs * overlap / boxes;  // boxes that begin within a box on the sweep axis
  const double cache = 1 + boxes / cells / boxes_in_cache;
  return cells * make_leaf +
         boxes * (order_copy * cache + start_run + compare_lanes * (0.5 + (run + same_bucket) / lanes));
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
  return work.boxes * (classify_box + 2 * scatter_copy + order_copy + start_run) +
         2 * axis.large * work.candidate_pairs * overlap_elsewhere * compare_lanes / lanes;
}

/// Tries every sweep axis w with every split along u, and every split along another axis v below that.
Choice cheapest(const AxisProfile (&axes)[3], Workload work, unsigned blocked) {
  Choice best{1e300, 0, -1, 1, false, work.boxes};
  for (int w = 0; w < 3; ++w) {
    const double overlap = axes[w].overlap;
    const double as_it_is = sweep_cost(work, 1, overlap);
    if (as_it_is < best.cost) best = {as_it_is, w, -1, 1, false, work.boxes};
    for (int u = 0; u < 3; ++u) {
      if ((blocked >> u & 1) != 0) continue;
      for (int slabs_u = 2; slabs_u <= Plan::most_slabs && can_split(axes[u], slabs_u); slabs_u *= 2) {
        const Workload in_u = split_work(work, slabs_u, axes[u], u == w);
        const double split_u = work.boxes * classify_box + in_u.boxes * scatter_copy;
        const double one_level =
            split_u + sweep_cost(in_u, slabs_u, overlap) + large_cost(work, axes[u], u == w ? 1 : overlap);
        if (one_level < best.cost) best = {one_level, w, u, slabs_u, true, in_u.boxes / slabs_u};
        for (int v = 0; v < 3; ++v) {
          if (v == u || (blocked >> v & 1) != 0) continue;
          for (int slabs_v = 2; slabs_v <= Plan::most_slabs && can_split(axes[v], slabs_v); slabs_v *= 2) {
            const double cells = double(slabs_u) * slabs_v;
            const Workload in_v = split_work(in_u, slabs_v, axes[v], v == w);
            const double share_v = 1.0 / slabs_v + axes[v].crossing;
            const double two_levels = split_u + in_u.boxes * classify_box + in_v.boxes * scatter_copy +
                                      sweep_cost(in_v, cells, overlap) +
                                      large_cost(work, axes[u], (u == w ? 1 : overlap) * share_v) +
                                      large_cost(in_u, axes[v], v == w ? 1 : overlap);
            if (two_levels < best.cost) best = {two_levels, w, u, slabs_u, false, in_v.boxes / cells};
          }
        }
      }
    }
  }
  return best;
}

}  // namespace

Sample::Sample(Arena& arena) {
  for (int d = 0; d < 3; ++d) {
    lo_[d] = arena.allocate<std::int32_t>(capacity);
    hi_[d] = arena.allocate<std::int32_t>(capacity);
  }
}

std::size_t Sample::wanted(std::size_t boxes) {
  return std::clamp<std::size_t>(boxes / 128, 64, capacity);
}

Plan make_plan(const Sample& sample, Workload work, unsigned blocked, Arena& arena) {
  const DefaultFloatEnvironment environment;
  Arena::Frame frame(arena);
  const std::size_t n = sample.size();
  Plan plan;
  if (n < 2) return plan;
  AxisProfile axes[3];
  for (int d = 0; d < 3; ++d) axes[d] = profile(sample, d, arena);

  const Choice best = cheapest(axes, work, blocked);
  plan.sweep.axis = best.sweep_axis;
  const std::uint64_t* lows = axes[best.sweep_axis].sorted_lows;
  plan.sweep.typical_min = key_of(lows[n / 50]);
  plan.sweep.typical_max = key_of(lows[n - 1 - n / 50]);
  plan.children_are_leaves = best.children_are_leaves;
  plan.leaf_size = best.leaf_size;
  if (best.split_axis < 0) return plan;

  const std::uint64_t* quantiles = axes[best.split_axis].sorted_lows;
  for (int s = 1; s < best.slabs; ++s) {
    const std::int32_t key = key_of(quantiles[n * static_cast<std::size_t>(s) / static_cast<std::size_t>(best.slabs)]);
    const std::int32_t last = plan.splitter_count == 0 ? key_of(quantiles[0]) : plan.splitters[plan.splitter_count - 1];
    if (key > last) plan.splitters[plan.splitter_count++] = key;
  }
  if (plan.splitter_count > 0) plan.split_axis = best.split_axis;
  return plan;
}

}  // namespace boxstream::detail
