// SPDX-License-Identifier: MIT
#include "search/cull.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include <boxstream/detail/float_environment.hpp>

#include "search/columns.hpp"
#include "search/occupancy.hpp"

namespace boxstream::detail {

namespace {

// To find out whether it pays takes 80 to 120 microseconds. To join so many boxes, with one set that large, takes at
// least 2 milliseconds, and 10 with both.
constexpr std::size_t least_boxes = 98304;
// To mark a set this much smaller than the other takes no longer than to look at a part of it.
constexpr std::size_t much_smaller = 16;
// Of a larger one, every so manieth block, in a grid of fewer cells so that a part fills it.
constexpr std::size_t part = 32;
constexpr unsigned cells_to_try = 32;
// Cells should be larger than most boxes, and stay in cache.
constexpr unsigned cells = 64, cells_of_many = 128;
constexpr std::size_t many_boxes = std::size_t{1} << 19;
// Of so many of a sample that are where the other set is, so many have to meet their own, or it says nothing.
constexpr double least_inside = 32, least_found = 8;
// To cull takes as long as to join a fifth of the boxes, and of sets that are partly apart a join takes less.
constexpr double most_left = 0.33, most_left_of_larger = 0.6;

/// Calls `look(boxes, valid)` for every `stride`th block of a source. Returns how many boxes are valid.
template <class S, class Look>
std::size_t for_each_block(const BoxSource<S>& source, std::size_t stride, const Look& look) {
  std::size_t valid_boxes = 0;
  BoxColumns boxes{};  // so that the last block, which may have fewer, has something in all lanes
  for (std::size_t begin = 0; begin < source.size(); begin += stride * load_block) {
    const std::uint64_t valid = source.load(begin, std::min(load_block, source.size() - begin), boxes);
    look(begin / load_block, boxes, valid);
    valid_boxes += static_cast<std::size_t>(std::popcount(valid));
  }
  return valid_boxes;
}

/// A few hundred boxes of a source, in runs so that they are read quickly.
struct Probe {
  static constexpr std::size_t blocks = 8, runs = 32, run = load_block * blocks / runs;

  BoxColumns boxes[blocks];
  std::uint64_t valid[blocks] = {};
  std::size_t size = 0;

  template <class S>
  explicit Probe(const BoxSource<S>& source) {
    for (std::size_t r = 0; r < runs; ++r) {
      BoxColumns read;
      const std::size_t begin = source.size() * r / runs, end = source.size() * (r + 1) / runs;
      const std::uint64_t found = source.load(begin, std::min(run, end - begin), read);
      BoxColumns& block = boxes[r * run / load_block];
      const std::size_t at = r * run % load_block;
      for (int d = 0; d < 3; ++d) {
        std::copy_n(read.lo[d], run, block.lo[d] + at);
        std::copy_n(read.hi[d], run, block.hi[d] + at);
      }
      valid[r * run / load_block] |= found << at;
      size += static_cast<std::size_t>(std::popcount(found));
    }
  }

  struct Count {
    double boxes = 0, found = 0;
  };

  /// How many boxes may meet what is marked; of all, or of those that are not beyond the grid.
  Count count(const CellGrid& grid, const Occupancy& marked, bool all) const {
    Count sum;
    for (std::size_t b = 0; b < blocks; ++b) {
      CellColumns where;
      locate_cells(boxes[b], grid, where);
      const std::uint64_t counted = all ? valid[b] : valid[b] & where.inside(grid);
      sum.boxes += std::popcount(counted);
      sum.found += std::popcount(counted & marked.may_meet(where));
    }
    return sum;
  }

  /// The keys between which they are on one axis, and between which most of them are.
  struct Ends {
    std::int32_t min = INT32_MIN, typical_min = INT32_MIN, typical_max = INT32_MAX, max = INT32_MAX;
  };

  Ends ends(int axis) const {
    constexpr std::size_t stride = 4;  // a part of them does for the typical ones
    Ends ends{INT32_MAX, 0, 0, INT32_MIN};
    std::int32_t lows[blocks * load_block / stride] = {}, highs[blocks * load_block / stride] = {};
    std::size_t n = 0;
    for (std::size_t i = 0; i < blocks * load_block; ++i) {
      if ((valid[i / load_block] >> i % load_block & 1) == 0) continue;
      const std::int32_t lo = boxes[i / load_block].lo[axis][i % load_block];
      const std::int32_t hi = boxes[i / load_block].hi[axis][i % load_block];
      ends.min = std::min(ends.min, lo);
      ends.max = std::max(ends.max, hi);
      if (i % stride != 0) continue;
      lows[n] = lo;
      highs[n++] = hi;
    }
    if (n == 0) return {};
    const std::size_t low = n / 50, high = n - 1 - low;
    std::nth_element(lows, lows + low, lows + n);
    std::nth_element(highs, highs + high, highs + n);
    ends.typical_min = lows[low];
    ends.typical_max = highs[high];
    return ends;
  }
};

/// The box where both sets are, with even cells where most of both are.
CellGrid make_grid(const Probe& a, const Probe& b, const KeyKind (&kinds)[3], unsigned cells_in_yz) {
  CellGrid grid{{}, cells_in_yz};
  for (int d = 0; d < 3; ++d) {
    const Probe::Ends of_a = a.ends(d), of_b = b.ends(d);
    const auto [min, max] = std::minmax(std::max(of_a.min, of_b.min), std::min(of_a.max, of_b.max));
    const auto [from, to] =
        std::minmax(std::max(of_a.typical_min, of_b.typical_min), std::min(of_a.typical_max, of_b.typical_max));
    grid.axes[d] = {min, max, Buckets(kinds[d], from, to, (d == 0 ? CellGrid::cells_in_x : cells_in_yz) - 2)};
  }
  return grid;
}

template <class S>
Span<const Record> gather(const BoxSource<S>& source, const std::uint64_t* kept, Arena& arena) {
  const std::size_t words = (source.size() + load_block - 1) / load_block;
  std::size_t size = 0;
  for (std::size_t w = 0; w < words; ++w) size += static_cast<std::size_t>(std::popcount(kept[w]));
  Record* const records = arena.allocate<Record>(size);
  Record* end = records;
  for (std::size_t w = 0; w < words; ++w)
    for (std::uint64_t left = kept[w]; left != 0; left &= left - 1)
      *end++ = source[w * load_block + static_cast<std::size_t>(std::countr_zero(left))];
  return {records, size};
}

/// Marks every `stride`th block of a source.
template <class S>
std::size_t mark(const BoxSource<S>& source, std::size_t stride, const CellGrid& grid, Occupancy& marks) {
  const std::size_t valid =
      for_each_block(source, stride, [&](std::size_t, const BoxColumns& boxes, std::uint64_t which) {
        CellColumns where;
        locate_cells(boxes, grid, where);
        marks.mark(where, which);
      });
  marks.finish();
  return valid;
}

/// What share of one set a sample says may meet the other, of which every `stride`th block is marked. A part of a set
/// may be too sparse to meet anything, so a sample of the same set tells how sparse it is where both are. Above 1 if
/// nothing can be said.
template <class S>
double share_left(const Probe& other, const BoxSource<S>& marked, const Probe& same, const CellGrid& grid,
                  std::size_t stride, Arena& arena) {
  const Arena::Frame frame(arena);
  Occupancy marks(grid.cells, arena);
  mark(marked, stride, grid, marks);
  const Probe::Count own = same.count(grid, marks, false), others = other.count(grid, marks, true);
  const double share = others.found / others.boxes;
  if (own.boxes < least_inside) return share;
  return own.found < least_found ? 2 : share * own.boxes / own.found;
}

/// Whether enough of both sets, with `a` the smaller, are where the other is not.
template <class S>
bool pays(const BoxSource<S>& a, const BoxSource<S>& b, const Probe& in_a, const Probe& in_b, const KeyKind (&kinds)[3],
          Arena& arena) {
  const DefaultFloatEnvironment environment;  // the same choice in every host
  if (a.size() * much_smaller <= b.size())
    return share_left(in_b, a, in_a, make_grid(in_a, in_b, kinds, cells), 1, arena) < most_left_of_larger;
  const CellGrid grid = make_grid(in_a, in_b, kinds, cells_to_try);
  const double left_of_b = share_left(in_b, a, in_a, grid, part, arena);
  return left_of_b < 2 * most_left && left_of_b + share_left(in_a, b, in_b, grid, part, arena) < 2 * most_left;
}

/// With `a` the smaller set.
template <class S>
Culled cull_smaller_first(const BoxSource<S>& a, const BoxSource<S>& b, const KeyKind (&kinds)[3], Arena& arena) {
  if (b.size() < least_boxes) return {};
  const Probe in_a(a), in_b(b);
  if (in_a.size == 0 || in_b.size == 0 || !pays(a, b, in_a, in_b, kinds, arena)) return {true, false, {}, {}, 0};
  const CellGrid grid = make_grid(in_a, in_b, kinds, a.size() < many_boxes ? cells : cells_of_many);
  Occupancy of_a(grid.cells, arena), of_b(grid.cells, arena);
  auto* const kept_a = arena.allocate<std::uint64_t>((a.size() + load_block - 1) / load_block);
  auto* const kept_b = arena.allocate<std::uint64_t>((b.size() + load_block - 1) / load_block);
  std::size_t valid = mark(a, 1, grid, of_a);
  valid += for_each_block(b, 1, [&](std::size_t block, const BoxColumns& boxes, std::uint64_t which) {
    CellColumns where;
    locate_cells(boxes, grid, where);
    kept_b[block] = of_a.may_meet(where) & which;
    of_b.mark(where, kept_b[block]);
  });
  of_b.finish();
  for_each_block(a, 1, [&](std::size_t block, const BoxColumns& boxes, std::uint64_t which) {
    CellColumns where;
    locate_cells(boxes, grid, where);
    kept_a[block] = of_b.may_meet(where) & which;
  });
  return {true, true, gather(a, kept_a, arena), gather(b, kept_b, arena), a.size() + b.size() - valid};
}

}  // namespace

template <class S>
Culled cull(const BoxSource<S>& a, const BoxSource<S>& b, const KeyKind (&kinds)[3], Arena& arena) {
  if (a.size() <= b.size()) return cull_smaller_first(a, b, kinds, arena);
  Culled culled = cull_smaller_first(b, a, kinds, arena);
  std::swap(culled.a, culled.b);
  return culled;
}

template Culled cull(const BoxSource<float>&, const BoxSource<float>&, const KeyKind (&)[3], Arena&);
template Culled cull(const BoxSource<double>&, const BoxSource<double>&, const KeyKind (&)[3], Arena&);

}  // namespace boxstream::detail
