// SPDX-License-Identifier: MIT
#include "batch/cuts/plan.hpp"

#include <algorithm>
#include <bit>
#include <iterator>

#include <boxstream/detail/float_environment.hpp>

#include "base/thresholds.hpp"
#include "batch/leaf/buckets.hpp"
#include "batch/leaf/ranked_lows.hpp"

namespace boxstream::detail {

namespace {

// Prices in nanoseconds on one AVX-512 machine. Only their proportions matter, to the choice of a plan and never to its
// result; docs/internals/performance.md has where they come from, and the benchmark's search for the best plan checks
// them.
constexpr double classify_box = 5.0;   // load one box and find its slabs
constexpr double classify_more = 2.0;  // find its slabs on a second axis
constexpr double scatter_copy = 4.0;   // write one 32-byte record to its slab
constexpr double order_copy = 8.0;     // put one box of a leaf into sweep order and pack it
constexpr double begin_block = 2.0;    // a box's share of the beginning of its block
constexpr double compare_block = thresholds.compare_block;
constexpr double emit_pair = 3.3;  // the exact test, and the writing
constexpr double block = 16.0;     // boxes in it
constexpr double window_of_block =
    19.0;  // boxes that a block is compared with whatever their size: itself, and a bucket
constexpr double widest_of_block = 1.4;  // how much farther the widest box of a block reaches than the average
constexpr double make_leaf = thresholds.make_leaf;
constexpr auto boxes_in_cache = static_cast<double>(thresholds.boxes_in_cache);
constexpr double beyond_cache = 0.1;       // how much dearer each doubling of a leaf beyond makes ordering it
constexpr double too_large = 4;            // by this factor a leaf of more than most_in_leaf has to be cheaper
constexpr double most_crossed = 2.5;       // boundaries of slabs that a box may cross on average
constexpr double most_copies_at_once = 2;  // of a box, on average, for cuts of two axes in one pass
constexpr double large_step = 40.0;        // a box's share of joining the large boxes with all
constexpr double large_joins =
    12;  // comparisons of that, for each that the sample promises: boxes at borders, cuts not made
constexpr double clearly_more = 0.05;  // large boxes that make another profile of slabs worth a try

/// What the sample says of slabs along one axis if boxes that reach over more than `1 / share` of them are large.
struct SlabProfile {
  unsigned share = 0;
  double large = 0;     // share of large boxes; the others are small
  double crossing = 0;  // probability that a box is small and crosses a given splitter
  double stuck = 0;     // share of the largest group of small boxes with equal low ends, which no slabs can part
  double beside = 0;    // probability that a large box overlaps another on both of the other axes
  const std::uint64_t* small_lows = nullptr;  // sorted
  std::size_t small = 0;
};

// For a lattice of bars it is best to treat the bars as large, for boxes of equal length as small.
constexpr unsigned large_shares[] = {2, 4, 8};
// As such a share: boxes that reach far are better copied where they are few.
constexpr unsigned none_large = 1;

/// What the sample says of one axis.
struct AxisProfile {
  const std::uint64_t* sorted_lows = nullptr;
  double overlap = 0;            // probability that two boxes overlap here
  const float* reach = nullptr;  // of each box of the sample: share of the others that begin inside of it
  SlabProfile slabs[std::size(large_shares) + 1];
  int variants = 0;  // of them, that differ
};

/// What the sample says of one axis alone.
AxisProfile profile(const Sample& sample, int axis, Arena& arena) {
  AxisProfile p;
  const std::size_t n = sample.size();
  auto* const lows = arena.allocate<std::uint64_t>(n);
  for (std::size_t i = 0; i < n; ++i) lows[i] = ranked(sample.lo(axis)[i], i);
  std::sort(lows, lows + n);
  p.sorted_lows = lows;
  auto* const reach = arena.allocate<float>(n);
  double overlapping = 0;
  const auto size = static_cast<double>(n);
  for (std::size_t begin = 0, end = 0; begin < n; begin = end) {
    while (end < n && key_of(lows[end]) == key_of(lows[begin])) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      // Each pair once: boxes that begin inside this one, and half of those that begin where it does.
      const std::uint32_t box = position_of(lows[i]);
      const auto inside = static_cast<double>(count_below(lows, n, sample.hi(axis)[box], true) - end);
      reach[box] = static_cast<float>(inside / size);
      overlapping += inside + 0.5 * static_cast<double>(end - begin - 1);
    }
  }
  p.reach = reach;
  p.overlap = std::min(1.0, overlapping / (0.5 * size * (size - 1)) + 0.5 / size);
  return p;
}

/// The same of slabs along one axis, all three being known.
SlabProfile profile_slabs(const AxisProfile (&axes)[3], int u, std::size_t n, unsigned share, Arena& arena) {
  SlabProfile p;
  p.share = share;
  auto* const small_lows = arena.allocate<std::uint64_t>(n);
  const AxisProfile &axis = axes[u], &v = axes[(u + 1) % 3], &w = axes[(u + 2) % 3];
  std::size_t stuck = 1, equal = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint64_t low = axis.sorted_lows[i];
    const std::uint32_t box = position_of(low);
    if (axis.reach[box] * static_cast<float>(share) > 1) {
      p.beside += std::min(1.0, v.reach[box] + v.overlap / 2) * std::min(1.0, w.reach[box] + w.overlap / 2);
      continue;
    }
    p.crossing += axis.reach[box];
    equal = p.small > 0 && key_of(small_lows[p.small - 1]) == key_of(low) ? equal + 1 : 1;
    stuck = std::max(stuck, equal);
    small_lows[p.small++] = low;
  }
  const auto size = static_cast<double>(n);
  if (p.small < n) p.beside /= static_cast<double>(n - p.small);
  p.large = static_cast<double>(n - p.small) / size;
  p.crossing /= size;
  p.stuck = static_cast<double>(stuck - 1) / size;
  p.small_lows = small_lows;
  return p;
}

void profile_all(AxisProfile (&axes)[3], const Sample& sample, Arena& arena) {
  for (int d = 0; d < 3; ++d) axes[d] = profile(sample, d, arena);
  for (int d = 0; d < 3; ++d) {
    for (const unsigned share : large_shares) {
      SlabProfile* const next = axes[d].slabs + axes[d].variants;
      *next = profile_slabs(axes, d, sample.size(), share, arena);
      if (axes[d].variants == 0 || next->large > next[-1].large + clearly_more) ++axes[d].variants;
    }
    // Large boxes that the sample has missed are few.
    SlabProfile* const slabs = axes[d].slabs;
    if (slabs[0].large == 0)
      slabs[0].share = none_large;
    else if (slabs[0].large < thresholds.most_copied)
      slabs[axes[d].variants++] = profile_slabs(axes, d, sample.size(), none_large, arena);
  }
}

/// How many of the sample's pairs overlap on all axes: counted along the one on which the fewest do.
double share_of_pairs(const AxisProfile (&axes)[3], const Sample& sample) {
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (axes[d].overlap < axes[axis].overlap) axis = d;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const std::uint64_t* const lows = axes[axis].sorted_lows;
  const std::size_t n = sample.size();
  const std::size_t step = n / thresholds.boxes_for_pairs + 1;
  std::size_t pairs = 0, possible = 0;
  for (std::size_t i = 0; i < n; i += step) {
    possible += n - 1 - i;
    const std::uint32_t a = position_of(lows[i]);
    for (std::size_t j = i + 1; j < n && key_of(lows[j]) <= sample.hi(axis)[a]; ++j) {
      const std::uint32_t b = position_of(lows[j]);
      const bool meets_u = sample.lo(u)[a] <= sample.hi(u)[b] && sample.lo(u)[b] <= sample.hi(u)[a];
      const bool meets_v = sample.lo(v)[a] <= sample.hi(v)[b] && sample.lo(v)[b] <= sample.hi(v)[a];
      pairs += meets_u && meets_v ? 1 : 0;
    }
  }
  return static_cast<double>(pairs) / static_cast<double>(possible);
}

struct Choice {
  double cost;
  int sweep_axis;
  int split_axis;
  const SlabProfile* profile;
  int slabs;
  bool children_are_leaves;
  double leaf_size;
  int column_axis = -1;  // of a second cut in the same pass
  int columns = 1;
};

double sweep_cost(Workload work, double cells, double overlap) {
  const double boxes = std::max(work.boxes, 1.0);
  const double scratch = boxes / cells > static_cast<double>(thresholds.most_in_leaf) ? too_large : 1;
  const double run = work.candidate_pairs * overlap / boxes;  // boxes that begin within a box on the sweep axis
  const double cache = 1 + beyond_cache * std::bit_width(static_cast<std::uint64_t>(boxes / cells / boxes_in_cache));
  return cells * make_leaf +
         scratch * boxes *
             (order_copy * cache + begin_block + compare_block * (window_of_block + widest_of_block * run) / block) +
         emit_pair * work.pairs;
}

/// The work that is left, over all cells, when each of `slabs` slabs gets its boxes and the copies of those that cross.
/// Slabs across the sweep axis save no comparisons, for the sweep would not have made them; they only make leaves fit
/// the cache.
Workload split_work(Workload work, double slabs, const SlabProfile& axis, bool is_sweep_axis) {
  const double share = 1 / slabs + axis.crossing;  // of the boxes, in one slab
  return {work.boxes * slabs * share, work.candidate_pairs * (is_sweep_axis ? 1 : slabs * share * share),
          work.pairs * (1 + slabs * axis.crossing / 2)};
}

/// Whether low ends differ enough for that many slabs, and boxes are not copied too often.
bool can_split(const SlabProfile& axis, int slabs) {
  return axis.stuck * slabs <= 1 && axis.crossing * slabs <= most_crossed;
}

/// Boxes that span many slabs are taken out and joined with everything apart, without this axis.
double large_cost(Workload work, const SlabProfile& axis) {
  if (axis.large == 0) return 0;
  return work.boxes * large_step +
         large_joins * axis.large * work.candidate_pairs * axis.beside * compare_block / block;
}

constexpr int slab_counts[] = {2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
static_assert(slab_counts[std::size(slab_counts) - 1] == Plan::most_slabs);

// Up to here no cut pays, and further on one is as good as two.
constexpr std::size_t no_level_below = thresholds.boxes_in_cache;
constexpr auto one_level_below = static_cast<double>(thresholds.one_level_below);

// Prices are not smooth: a smaller rise does not mean that more slabs cost more.
constexpr double clearly = 1.02;

/// Cuts along u, and below that along another axis v, in front of a sweep along w.
class Cuts {
 public:
  Cuts(const AxisProfile (&axes)[3], Workload work, unsigned blocked, int w, Choice& best)
      : axes_(axes), work_(work), blocked_(blocked), w_(w), best_(best) {}

  /// As more slabs first make a plan cheaper and then dearer, the first that is clearly dearer ends a series.
  void try_slabs(int u, const SlabProfile& slabs_of_u) {
    double before = 1e300;
    for (const int slabs : slab_counts) {
      if (!can_split(slabs_of_u, slabs)) break;
      if (slabs_of_u.share > large_shares[0] && slabs < 2 * static_cast<int>(slabs_of_u.share)) continue;
      const double cheapest = try_cut(u, slabs_of_u, slabs);
      if (cheapest > clearly * before) break;
      before = cheapest;
    }
  }

 private:
  /// The cost of the cheapest plan with this cut.
  double try_cut(int u, const SlabProfile& slabs_of_u, int slabs) {
    const Workload left = split_work(work_, slabs, slabs_of_u, u == w_);
    const double split = work_.boxes * classify_box + left.boxes * scatter_copy;
    const double large = large_cost(work_, slabs_of_u);
    const double one_level = split + sweep_cost(left, slabs, axes_[w_].overlap) + large;
    if (one_level < best_.cost) best_ = {one_level, w_, u, &slabs_of_u, slabs, true, left.boxes / slabs};
    double cheapest = one_level;
    for (int v = 0; v < 3 && work_.boxes > one_level_below; ++v) {
      if (v == u || (blocked_ >> v & 1) != 0) continue;
      const SlabProfile& slabs_of_v = axes_[v].slabs[0];
      double before = 1e300;
      for (const int slabs_v : slab_counts) {
        if (!can_split(slabs_of_v, slabs_v)) break;
        const double cells = double(slabs) * slabs_v;
        const Workload left_v = split_work(left, slabs_v, slabs_of_v, v == w_);
        const bool at_once =  // rather than slab by slab
            cells <= Grid::most_cells && slabs_of_v.large == 0 && left_v.boxes <= most_copies_at_once * work_.boxes;
        const double cuts = at_once ? work_.boxes * (classify_box + classify_more) + left_v.boxes * scatter_copy
                                    : split + left.boxes * classify_box + left_v.boxes * scatter_copy;
        const double two_levels = cuts + sweep_cost(left_v, cells, axes_[w_].overlap) +
                                  large * (at_once ? 1 : 1.0 / slabs_v + slabs_of_v.crossing) +
                                  large_cost(left, slabs_of_v);
        if (two_levels < best_.cost) {
          best_ = {two_levels, w_, u, &slabs_of_u, slabs, at_once, left_v.boxes / cells};
          if (at_once) {
            best_.column_axis = v;
            best_.columns = slabs_v;
          }
        }
        cheapest = std::min(cheapest, two_levels);
        if (two_levels > clearly * before) break;
        before = two_levels;
      }
    }
    return cheapest;
  }

  const AxisProfile (&axes_)[3];
  Workload work_;
  unsigned blocked_;
  int w_;
  Choice& best_;
};

/// Of every sweep axis, with and without cuts.
Choice cheapest(const AxisProfile (&axes)[3], Workload work, unsigned blocked) {
  Choice best{1e300, 0, -1, nullptr, 1, false, work.boxes};
  for (int w = 0; w < 3; ++w) {
    const double as_it_is = sweep_cost(work, 1, axes[w].overlap);
    if (as_it_is < best.cost) best = {as_it_is, w, -1, nullptr, 1, false, work.boxes};
    if (work.boxes <= double{no_level_below}) continue;
    Cuts cuts(axes, work, blocked, w, best);
    for (int u = 0; u < 3; ++u)
      for (int i = 0; i < axes[u].variants && (blocked >> u & 1) == 0; ++i) cuts.try_slabs(u, axes[u].slabs[i]);
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

Choice choose_by_hand(const AxisProfile (&axes)[3], const FixedPlan& plan, int depth) {
  if (depth >= plan.levels) return {0, plan.sweep_axis, -1, nullptr, 1, false, 0};
  const FixedPlan::Level& level = plan.level[depth];
  const bool is_last = depth + 1 == plan.levels;
  Choice choice{0, plan.sweep_axis, level.axis, &axes[level.axis].slabs[0], level.slabs, is_last, 1e300};
  if (is_last) return choice;
  const FixedPlan::Level& next = plan.level[depth + 1];
  if (level.slabs * next.slabs > int{Grid::most_cells} || next.axis == level.axis) return choice;
  choice.children_are_leaves = true;
  choice.column_axis = next.axis;
  choice.columns = next.slabs;
  return choice;
}

/// Sorted keys of which even buckets part the boxes.
struct KeyRange {
  std::int32_t min, max;
};

constexpr std::uint32_t resolution = 32 * Slabs::most;

/// Where boxes are to be distinguished: the sample without its outliers; but while a third of it shares one bucket,
/// what is in that. So a heap is cut and not what lies around it, and two thirds at most go to the outermost slabs.
KeyRange typical_range(const std::uint64_t* sorted_lows, std::size_t n, KeyKind kind) {
  KeyRange range{key_of(sorted_lows[n / 50]), key_of(sorted_lows[n - 1 - n / 50])};
  for (std::size_t first = n / 50, last = n - 1 - n / 50;;) {
    const Buckets buckets(kind, range.min, range.max, resolution);
    std::size_t most = 0, most_first = 0;
    for (std::size_t i = first, begin = first; i <= last; ++i) {
      if (buckets(key_of(sorted_lows[i])) != buckets(key_of(sorted_lows[begin]))) begin = i;
      if (i - begin < most) continue;
      most = i - begin;
      most_first = begin;
    }
    const KeyRange inside{key_of(sorted_lows[most_first]), key_of(sorted_lows[most_first + most])};
    const bool is_smaller = inside.min != range.min || inside.max != range.max;
    if (3 * most < n || inside.min == inside.max || !is_smaller) return range;
    range = inside;
    first = most_first;
    last = most_first + most;
  }
}

/// Slabs at the quantiles of the sample. Those in which no box of it begins are left out.
void cut(Slabs& slabs, const SlabProfile& profile, int wanted) {
  const std::uint64_t *const lows = profile.small_lows, *const end = lows + profile.small;
  const std::uint64_t* const first = std::find_if(lows, end, [](auto low) { return key_of(low) != INT32_MIN; });
  std::int32_t last[Slabs::most], begin = first == end ? INT32_MIN : key_of(*first);
  unsigned boundaries = 0;
  for (int s = 1; s < wanted; ++s) {
    const std::int32_t key =
        key_of(lows[profile.small * static_cast<std::size_t>(s) / static_cast<std::size_t>(wanted)]);
    if (key <= begin) continue;
    last[boundaries++] = key - 1;
    begin = key;
  }
  slabs.cut(last, boundaries);
}

/// As the choice says; `axes` are what it was made from.
void cut(Grid& grid, const Choice& choice, const AxisProfile (&axes)[3]) {
  cut(grid.rows, *choice.profile, choice.slabs);
  const unsigned rows = grid.rows.count;
  if (rows == 1) return;
  grid.rows.axis = choice.split_axis;
  grid.most_crossed = rows < 4 ? rows : rows / choice.profile->share;
  grid.rows.most_crossed = choice.profile->large == 0 ? rows : grid.most_crossed;
  if (choice.column_axis < 0) return;
  cut(grid.columns, axes[choice.column_axis].slabs[0], choice.columns);
  grid.columns.axis = choice.column_axis;
}

}  // namespace

Sample::Sample(Arena& arena) {
  for (int d = 0; d < 3; ++d) {
    lo_[d] = arena.allocate<std::int32_t>(capacity);
    hi_[d] = arena.allocate<std::int32_t>(capacity);
  }
}

std::size_t Sample::wanted(std::size_t boxes) {
  constexpr std::size_t least = thresholds.least_sample, for_level = thresholds.sample_for_level;
  if (boxes <= no_level_below) return std::clamp(boxes / 16, least, thresholds.sample_for_axis);
  return boxes < thresholds.one_level_below ? std::clamp(boxes / 16, least, for_level)
                                            : std::clamp(boxes / 128, for_level, capacity);
}

Plan make_plan(const Sample& sample, Workload work, unsigned blocked, int depth, const KeyKind (&kinds)[3],
               const FixedPlan* by_hand, Arena& arena) {
  const DefaultFloatEnvironment environment;  // the same plan in every host
  Arena::Frame frame(arena);
  const std::size_t n = sample.size();
  Plan plan;
  if (n < 2) return plan;
  if (work.boxes <= double{no_level_below} && by_hand == nullptr) return sweep_alone(sample);
  AxisProfile axes[3];
  profile_all(axes, sample, arena);

  if (work.boxes > one_level_below) work.pairs = work.candidate_pairs * share_of_pairs(axes, sample);
  const Choice best =
      by_hand != nullptr && blocked == 0 ? choose_by_hand(axes, *by_hand, depth) : cheapest(axes, work, blocked);
  plan.sweep.axis = best.sweep_axis;
  const KeyRange range = typical_range(axes[best.sweep_axis].sorted_lows, n, kinds[best.sweep_axis]);
  plan.sweep.typical_min = range.min;
  plan.sweep.typical_max = range.max;
  plan.children_are_leaves = best.children_are_leaves;
  plan.leaf_size = best.leaf_size;
  if (best.split_axis < 0) return plan;

  if (best.profile->small != 0) cut(plan.grid, best, axes);
  return plan;
}

}  // namespace boxstream::detail
