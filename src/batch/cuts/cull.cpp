// SPDX-License-Identifier: MIT
#include "batch/cuts/cull.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include <boxstream/detail/float_environment.hpp>

#include "base/even_parts.hpp"
#include "base/thresholds.hpp"
#include "batch/cuts/occupancy.hpp"
#include "batch/records/columns.hpp"

namespace boxstream::detail {

namespace {

constexpr unsigned most_cells(std::size_t boxes, bool others_are_few) {
  if (boxes < thresholds.few_cells_below) return 64;
  return boxes >= thresholds.many_cells_from || others_are_few ? 128 : 64;
}
// As few boxes as possible should reach over more than two of them: this is how many more they reach into on average.
constexpr double reach_in_cells = 0.75;
constexpr unsigned least_cells = 4;
// Culling takes as long as a join of a fifth of the boxes; a join of sets that are partly disjoint takes less.
constexpr double most_left = 0.33, most_left_of_larger = 0.6;

/// Calls `look(boxes, valid)` for every `stride`th block of a source. Returns how many boxes are valid.
template <class Source, class Look>
std::size_t for_each_block(const Source& source, std::size_t stride, const Look& look) {
  std::size_t valid_boxes = 0;
  BoxColumns boxes{};  // initialised, because the last block may not fill all lanes
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

  template <class Source>
  explicit Probe(const Source& source) {
    for (std::size_t r = 0; r < runs; ++r) {
      BoxColumns read;
      const std::size_t begin = begin_of_part(source.size(), r, runs), end = begin_of_part(source.size(), r + 1, runs);
      if (begin == end) continue;
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
    double share() const { return found / boxes; }
  };

  /// Number of boxes that touch a marked cell; of all, or of those inside the grid.
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

  /// Into how many more cells than one they reach, on average.
  double reach(const CellGrid& grid, int axis) const {
    std::uint64_t sum = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
      CellColumns where;
      locate_cells(boxes[b], grid, where);
      for (std::uint64_t left = valid[b]; left != 0; left &= left - 1) {
        const int i = std::countr_zero(left);
        sum += where.last[axis][i] - where.first[axis][i];
      }
    }
    return static_cast<double>(sum) / static_cast<double>(size);
  }

  /// The keys between which they are on one axis, and between which most of them are.
  struct Ends {
    std::int32_t min, typical_min, typical_max, max;
  };

  Ends ends(int axis) const {
    constexpr std::size_t stride = 8;  // a part is enough for the typical range, without the outermost
    std::int32_t min = INT32_MAX, max = INT32_MIN, least[2] = {min, min}, most[2] = {max, max};
    for (std::size_t i = 0; i < blocks * load_block; ++i) {
      if ((valid[i / load_block] >> i % load_block & 1) == 0) continue;
      const std::int32_t lo = boxes[i / load_block].lo[axis][i % load_block];
      const std::int32_t hi = boxes[i / load_block].hi[axis][i % load_block];
      min = std::min(min, lo);
      max = std::max(max, hi);
      if (i % stride != 0) continue;
      least[1] = std::min(least[1], std::max(least[0], lo));
      least[0] = std::min(least[0], lo);
      most[1] = std::max(most[1], std::min(most[0], hi));
      most[0] = std::max(most[0], hi);
    }
    return {min, least[1], most[1], max};
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
    grid.axes[d] = {kinds[d], min, max, from, to, d == 0 ? CellGrid::cells_in_x : cells_in_yz};
  }
  return grid;
}

/// Writes those boxes of a block that have their bit in `kept`. Returns where the next ones go.
Record* gather(std::size_t block, const BoxColumns& boxes, std::uint64_t kept, Record* end) {
  const auto &lo = boxes.lo, &hi = boxes.hi;
  for (; kept != 0; kept &= kept - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(kept));
    const auto id = static_cast<std::uint32_t>(block * load_block + i);
    *end++ = {{lo[0][i], lo[1][i], lo[2][i]}, id, {hi[0][i], hi[1][i], hi[2][i]}, 0};
  }
  return end;
}

/// The same with fewer cells where most boxes would reach over several of them.
CellGrid make_fitting_grid(const Probe& a, const Probe& b, const KeyKind (&kinds)[3], unsigned most) {
  const CellGrid finest = make_grid(a, b, kinds, most);
  const auto wanted = [&](int axis) {
    const double reach = std::max(a.reach(finest, axis), b.reach(finest, axis));
    if (reach <= reach_in_cells) return most;
    return std::max(static_cast<unsigned>(most * reach_in_cells / reach), least_cells);
  };
  CellGrid grid = finest;
  grid.cells = 0;
  for (int d = 1; d < 3; ++d) {
    CellGrid::Axis& axis = grid.axes[d];
    const unsigned cells = wanted(d);
    axis = {kinds[d], axis.min, axis.max, axis.from, axis.to, cells};
    grid.cells = std::max(grid.cells, cells);
  }
  return grid;
}

/// Estimates, by a sample, the share of one set that may overlap the other, of which a part is marked. A part may be
/// too sparse to overlap anything, so a sample of the same set measures its density where both sets are. Above 1 if
/// unknown.
template <class Source>
double share_left(const Probe& other, const Source& marked, const Probe& same, const CellGrid& grid, Arena& arena) {
  const Arena::Frame frame(arena);
  Occupancy marks(grid.cells, arena);
  for_each_block(marked, thresholds.cull_part, [&](std::size_t, const BoxColumns& boxes, std::uint64_t which) {
    CellColumns where;
    locate_cells(boxes, grid, where);
    marks.mark(where, which);
  });
  marks.finish();
  const Probe::Count own = same.count(grid, marks, false);
  const double share = other.count(grid, marks, true).share();
  if (own.boxes < thresholds.least_inside) return share;
  return own.found < thresholds.least_found ? 2 : share / own.share();
}

/// Whether enough of both sets, of about the same size, are where the other is not.
template <class Source>
bool most_are_disjoint(const Source& a, const Source& b, const Probe& in_a, const Probe& in_b,
                       const KeyKind (&kinds)[3], Arena& arena) {
  const CellGrid grid = make_grid(in_a, in_b, kinds, thresholds.cells_to_try);
  const double left_of_b = share_left(in_b, a, in_a, grid, arena);
  return left_of_b < 2 * most_left && left_of_b + share_left(in_a, b, in_b, grid, arena) < 2 * most_left;
}

/// A set of which the cells are kept, and marked.
struct Marked {
  CellColumns* cells;
  Occupancy marks;
  std::size_t valid_boxes;

  template <class Source>
  Marked(const Source& source, const CellGrid& grid, Arena& arena)
      : cells(arena.allocate<CellColumns>((source.size() + load_block - 1) / load_block)), marks(grid.cells, arena) {
    valid_boxes = for_each_block(source, 1, [&](std::size_t block, const BoxColumns& boxes, std::uint64_t which) {
      locate_cells(boxes, grid, cells[block]);
      marks.mark(cells[block], which);
    });
    marks.finish();
  }
};

Span<Record> between(Record* begin, Record* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

/// Keeps the boxes of `b` that may overlap the marked `a`, and the boxes of `a` that may overlap these; all of `a` if
/// it is much smaller.
template <class Source>
Culled keep_neighbours(const Source& a, const Marked& in_a, const Source& b, const CellGrid& grid, bool keep_a,
                       Arena& arena) {
  Occupancy marks_of_b(grid.cells, arena);
  Record *const kept_b = arena.allocate<Record>(b.size()), *end_b = kept_b;
  const std::size_t valid = for_each_block(b, 1, [&](std::size_t block, const BoxColumns& boxes, std::uint64_t which) {
    CellColumns where;
    locate_cells(boxes, grid, where);
    const std::uint64_t kept = in_a.marks.may_meet(where) & which;
    if (!keep_a) marks_of_b.mark(where, kept);
    end_b = gather(block, boxes, kept, end_b);
  });
  marks_of_b.finish();
  Record *const kept_a = arena.allocate<Record>(a.size()), *end_a = kept_a;
  for_each_block(a, 1, [&](std::size_t block, const BoxColumns& boxes, std::uint64_t which) {
    const std::uint64_t kept = keep_a ? which : which & marks_of_b.may_meet(in_a.cells[block]);
    end_a = gather(block, boxes, kept, end_a);
  });
  return {true, between(kept_a, end_a), between(kept_b, end_b), a.size() - in_a.valid_boxes, b.size() - valid};
}

/// With `a` the smaller set.
template <class Source>
Culled cull_smaller_first(const Source& a, const Source& b, const KeyKind (&kinds)[3], Arena& arena) {
  const bool is_much_smaller = a.size() * thresholds.much_smaller <= b.size();
  if (b.size() < (is_much_smaller ? thresholds.cull_much_smaller : thresholds.cull_equals)) return {};
  const DefaultFloatEnvironment environment;  // the same choice, and the same cells, in every host
  const Probe of_a(a), of_b(b);
  if (of_a.size == 0 || of_b.size == 0) return {};
  if (!is_much_smaller && !most_are_disjoint(a, b, of_a, of_b, kinds, arena)) return {};
  const CellGrid grid = make_fitting_grid(of_a, of_b, kinds, most_cells(b.size(), is_much_smaller));
  const Marked in_a(a, grid, arena);
  // To mark a much smaller set takes no longer than to look at a part of it.
  if (is_much_smaller && of_b.count(grid, in_a.marks, true).share() > most_left_of_larger) return {};
  return keep_neighbours(a, in_a, b, grid, is_much_smaller, arena);
}

}  // namespace

template <class Source>
Culled cull(const Source& a, const Source& b, const KeyKind (&kinds)[3], Arena& arena) {
  if (a.size() <= b.size()) return cull_smaller_first(a, b, kinds, arena);
  Culled culled = cull_smaller_first(b, a, kinds, arena);
  std::swap(culled.a, culled.b);
  std::swap(culled.invalid_a, culled.invalid_b);
  return culled;
}

template Culled cull(const BoxSource<float>&, const BoxSource<float>&, const KeyKind (&)[3], Arena&);
template Culled cull(const BoxSource<double>&, const BoxSource<double>&, const KeyKind (&)[3], Arena&);

}  // namespace boxstream::detail
