// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/box_span.hpp>
#include <boxstream/detail/export.hpp>
#include <boxstream/executor.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>
#include <boxstream/stats.hpp>

namespace boxstream {

/// Group and mask bits of one box. Two boxes may pair when each one's group meets the other's mask:
/// (a.group & b.mask) != 0 and (b.group & a.mask) != 0.
struct Filter {
  std::uint32_t group = 1;
  std::uint32_t mask = ~std::uint32_t{0};
};

constexpr bool accepts(Filter a, Filter b) {
  return (a.group & b.mask) != 0 && (b.group & a.mask) != 0;
}

/// Which boxes of a search pair. As it is made: all that overlap or touch.
struct PairRules {
  /// None, or one for each box; `filters_b` are those of the second of two sets.
  Span<const Filter> filters = {}, filters_b = {};
  /// None, or one for each box: boxes with equal ids (of nets, parts, bodies) do not pair. Of two sets, for both.
  Span<const std::uint32_t> ids = {}, ids_b = {};
  /// Whether boxes pair that share no more than a face, an edge or a corner. If not, a box pairs with another when
  /// a.min < b.max and b.min < a.max on every axis: as open and as half-open boxes do. So a flat box pairs with boxes
  /// that strictly contain its plane, but not with another flat box in the same plane.
  bool touching = true;
  /// Boxes pair, too, that are at most so far apart on every axis (less than that, if touching does not count), in the
  /// unit of the coordinates: a.min <= b.max + tolerance and b.min <= a.max + tolerance, of which nothing is rounded.
  /// Finite and >= 0.
  double tolerance = 0;
};

/// Receives pairs in batches (never empty; valid during the call only) and returns false to stop the search.
/// Runs on the calling thread; may throw, and the exception passes through.
using PairSink = FunctionRef<bool(Span<const Pair>)>;

/// Many sets in one array of boxes: set i has boxes offsets[i] up to, not including, offsets[i + 1]. There is one
/// offset more than sets; they ascend from 0 to the number of boxes, and equal ones make an empty set.
using SetOffsets = Span<const std::uint64_t>;

/// The pairs of many sets, one set after the other: those of set i are pairs[offsets[i]] up to, not including,
/// pairs[offsets[i + 1]]. Of one search there are as many offsets as were given.
struct PairsOfSets {
  std::vector<Pair> pairs;
  std::vector<std::uint64_t> offsets;
};

/// How the pairs of a batch are found; which ones they are does not depend on it.
enum class Method : std::uint8_t {
  /// Cuts into many slabs or cells at once, planned by samples, and vectorised sweeps: the fastest for nearly all
  /// inputs.
  planned,
  /// The streamed binary segment tree with scans of Zomorodian and Edelsbrunner, Fast software for box intersections
  /// (2002), alone: several times slower, and worth comparing with.
  hybrid
};

/// How a Detector runs.
struct DetectorOptions {
  /// Borrowed for the life of the Detector; null: everything runs on the calling thread.
  Executor* executor = nullptr;

  Method method = Method::planned;

  /// Of `Method::hybrid`: nodes of the tree with fewer intervals or points are scanned, in the dimensions that the
  /// paper has: trees over z, then y, and scans along x. 0: samples tell when to scan, and the order of dimensions.
  std::uint32_t cutoff = 0;
};

/// The neighbours of each box: those of box i are indices[offsets[i]] up to, not including, indices[offsets[i + 1]],
/// ascending. There is one offset more than boxes.
struct Neighbours {
  std::vector<std::uint64_t> offsets;
  std::vector<std::uint32_t> indices;
};

/// Whether both boxes of a pair are listed as neighbours of each other, or only the larger index as a neighbour of the
/// smaller one: then each pair is there once.
enum class Directions { both, one };

/// Finds every pair of boxes that overlap or touch, each exactly once, and nothing else.
///
/// @par Shapes
/// Boxes are closed; shared faces count; no margin is added, unless rules say otherwise. Invalid boxes pair with
/// nothing and are counted in `Stats::invalid`. At most 2^32 - 2 boxes a set; pair counts are 64-bit.
///
/// @par Coordinates
/// Floats, doubles, integers of 32 or of 64 bits; exact for all. Those of two sets may differ.
///
/// @par Order
/// A function of the input alone; the same for any executor, thread count and SIMD width.
///
/// @par Rules
/// Pairs that they refuse are never delivered.
///
/// @par Memory
/// Scratch of O(n), kept and reused; once warm, a search of the same size and kind allocates nothing. One set takes 210
/// bytes a box (doubles 290) up to 65 536 boxes, of which some half is touched, and at most 130 of more, 180 where most
/// of them are long. Integers, a tolerance and sets of different coordinates take a copy of the boxes. Where threads
/// search for a vector of pairs, what they find before its turn comes is kept too: 8 bytes a pair at most.
///
/// @par Threads
/// Use one Detector per thread: debug builds assert. Inputs are read during the call and not kept. They must not lie in
/// an output.
///
/// @par Errors
/// std::bad_alloc, std::length_error (too many boxes), std::invalid_argument (number of filters or ids, tolerance,
/// offsets of sets, an integer beyond +-2^53), and what a sink throws. The Detector stays usable. Vectors of an output
/// are then empty, never partial.
///
/// Nothing is kept between calls, and boxes have no identity but their index: see World.
class BOXSTREAM_API Detector {
  template <class Filters>
  using IfFilters = std::enable_if_t<std::is_convertible_v<const Filters&, Span<const Filter>>>;

 public:
  explicit Detector(DetectorOptions options = {});
  ~Detector();
  Detector(Detector&&) noexcept;
  Detector& operator=(Detector&&) noexcept;

  /// Pairs within one set; `out` is cleared first.
  Stats find_pairs(BoxSpan boxes, std::vector<Pair>& out, const PairRules& rules = {});

  /// Pairs between two sets; pairs within a set are not looked for.
  Stats find_pairs(BoxSpan a, BoxSpan b, std::vector<Pair>& out, const PairRules& rules = {});

  /// The same pairs in the same order, passed to `sink` while they are found, in O(n) memory for any number of pairs.
  Stats stream_pairs(BoxSpan boxes, PairSink sink, const PairRules& rules = {});
  Stats stream_pairs(BoxSpan a, BoxSpan b, PairSink sink, const PairRules& rules = {});

  /// The same pairs as neighbours of each box; between two sets, of each box of `a` those in `b`. Takes 8 bytes a pair
  /// beside the output, which are kept.
  Stats find_neighbours(BoxSpan boxes, Neighbours& out, const PairRules& rules = {},
                        Directions directions = Directions::both);
  Stats find_neighbours(BoxSpan a, BoxSpan b, Neighbours& out, const PairRules& rules = {});

  /// Many searches in one call, each within one of many `sets`. Indices are those of the whole arrays, of boxes and
  /// in rules. Of each set the pairs are those of a search of its own, in the same order, and sets follow each
  /// other in theirs. With an executor, small sets are shared among its threads, and large ones are each searched by
  /// all. At most 2^32 - 2 boxes in all sets together; sizes may differ as they like.
  Stats find_pairs(BoxSpan boxes, SetOffsets sets, PairsOfSets& out, const PairRules& rules = {});

  /// The same between set i of `sets_a` and set i of `sets_b`, of which there are as many.
  Stats find_pairs(BoxSpan a, SetOffsets sets_a, BoxSpan b, SetOffsets sets_b, PairsOfSets& out,
                   const PairRules& rules = {});

  /// The same, passed to `sink`; a batch may have pairs of several sets.
  Stats stream_pairs(BoxSpan boxes, SetOffsets sets, PairSink sink, const PairRules& rules = {});
  Stats stream_pairs(BoxSpan a, SetOffsets sets_a, BoxSpan b, SetOffsets sets_b, PairSink sink,
                     const PairRules& rules = {});

  /// The same searches, with filters as all of their rules.
  template <class Filters = Span<const Filter>, class = IfFilters<Filters>>
  Stats find_pairs(BoxSpan boxes, std::vector<Pair>& out, const Filters& filters) {
    return find_pairs(boxes, out, only(filters));
  }
  template <class Filters = Span<const Filter>, class = IfFilters<Filters>>
  Stats find_pairs(BoxSpan a, BoxSpan b, std::vector<Pair>& out, const Filters& filters_a,
                   Span<const Filter> filters_b = {}) {
    return find_pairs(a, b, out, only(filters_a, filters_b));
  }
  template <class Filters = Span<const Filter>, class = IfFilters<Filters>>
  Stats stream_pairs(BoxSpan boxes, PairSink sink, const Filters& filters) {
    return stream_pairs(boxes, sink, only(filters));
  }
  template <class Filters = Span<const Filter>, class = IfFilters<Filters>>
  Stats stream_pairs(BoxSpan a, BoxSpan b, PairSink sink, const Filters& filters_a, Span<const Filter> filters_b = {}) {
    return stream_pairs(a, b, sink, only(filters_a, filters_b));
  }
  template <class Filters = Span<const Filter>, class = IfFilters<Filters>>
  Stats find_pairs(BoxSpan boxes, SetOffsets sets, PairsOfSets& out, const Filters& filters) {
    return find_pairs(boxes, sets, out, only(filters));
  }
  template <class Filters = Span<const Filter>, class = IfFilters<Filters>>
  Stats find_pairs(BoxSpan a, SetOffsets sets_a, BoxSpan b, SetOffsets sets_b, PairsOfSets& out,
                   const Filters& filters_a, Span<const Filter> filters_b = {}) {
    return find_pairs(a, sets_a, b, sets_b, out, only(filters_a, filters_b));
  }
  template <class Filters = Span<const Filter>, class = IfFilters<Filters>>
  Stats stream_pairs(BoxSpan boxes, SetOffsets sets, PairSink sink, const Filters& filters) {
    return stream_pairs(boxes, sets, sink, only(filters));
  }
  template <class Filters = Span<const Filter>, class = IfFilters<Filters>>
  Stats stream_pairs(BoxSpan a, SetOffsets sets_a, BoxSpan b, SetOffsets sets_b, PairSink sink,
                     const Filters& filters_a, Span<const Filter> filters_b = {}) {
    return stream_pairs(a, sets_a, b, sets_b, sink, only(filters_a, filters_b));
  }

  /// Bytes of scratch held at the moment.
  std::size_t scratch_bytes() const;

  /// Gives all scratch back; the next search takes it anew.
  void shrink_to_fit() noexcept;

 private:
  static PairRules only(Span<const Filter> filters, Span<const Filter> filters_b = {}) {
    PairRules rules;
    rules.filters = filters;
    rules.filters_b = filters_b;
    return rules;
  }

  struct BOXSTREAM_LOCAL Impl;
  std::unique_ptr<Impl> impl_;
};

/// One-off searches: a Detector made, used and dropped.
BOXSTREAM_API std::vector<Pair> find_pairs(BoxSpan boxes, const PairRules& rules = {});
BOXSTREAM_API std::vector<Pair> find_pairs(BoxSpan a, BoxSpan b, const PairRules& rules = {});

/// Name of the SIMD target that the sweeps run on here ("AVX3", "AVX2", "SSE4", "NEON", "EMU128", ...).
BOXSTREAM_API const char* simd_target();

}  // namespace boxstream
