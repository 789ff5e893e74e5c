// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstdint>
#include <memory>
#include <vector>

#include <boxstream/aabb.hpp>
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

/// Receives pairs in batches (never empty; valid during the call only) and returns false to stop the search.
/// Runs on the calling thread; may throw, and the exception passes through.
using PairSink = FunctionRef<bool(Span<const Pair>)>;

/// How a Detector runs.
struct DetectorOptions {
  /// Borrowed for the life of the Detector; null: everything runs on the calling thread.
  Executor* executor = nullptr;
};

/// Finds every pair of boxes that overlap or touch, each exactly once, and nothing else.
///
/// Shapes: boxes are closed; shared faces count; no margin is added. Invalid boxes pair with nothing and are
/// counted in `Stats::invalid`. At most 2^32 - 2 boxes a set; pair counts are 64-bit.
/// Order: a function of the input alone; the same for any executor, thread count and SIMD width.
/// Filters: empty, or one for each box; pairs that they refuse are never delivered.
/// Memory: scratch of O(n), kept and reused; once warm, a search of the same size and kind allocates nothing.
/// Threads: use one Detector per thread: debug builds assert. Inputs are read during the call and not kept.
/// Errors: std::bad_alloc, std::length_error (too many boxes), std::invalid_argument (filter count), and what a sink
/// throws. The Detector stays usable. A vector output is then empty, never partial.
///
/// Nothing is kept between calls, and boxes have no identity but their index: see World.
class BOXSTREAM_API Detector {
 public:
  explicit Detector(DetectorOptions options = {});
  ~Detector();
  Detector(Detector&&) noexcept;
  Detector& operator=(Detector&&) noexcept;

  /// Pairs within one set; `out` is cleared first.
  Stats find_pairs(Span<const Aabb> boxes, std::vector<Pair>& out, Span<const Filter> filters = {});
  Stats find_pairs(Span<const Aabb64> boxes, std::vector<Pair>& out, Span<const Filter> filters = {});

  /// Pairs between two sets; pairs within a set are not looked for.
  Stats find_pairs(Span<const Aabb> a, Span<const Aabb> b, std::vector<Pair>& out, Span<const Filter> filters_a = {},
                   Span<const Filter> filters_b = {});
  Stats find_pairs(Span<const Aabb64> a, Span<const Aabb64> b, std::vector<Pair>& out,
                   Span<const Filter> filters_a = {}, Span<const Filter> filters_b = {});

  /// The same pairs in the same order, passed to `sink` while they are found, in O(n) memory for any number of pairs.
  Stats stream_pairs(Span<const Aabb> boxes, PairSink sink, Span<const Filter> filters = {});
  Stats stream_pairs(Span<const Aabb64> boxes, PairSink sink, Span<const Filter> filters = {});
  Stats stream_pairs(Span<const Aabb> a, Span<const Aabb> b, PairSink sink, Span<const Filter> filters_a = {},
                     Span<const Filter> filters_b = {});
  Stats stream_pairs(Span<const Aabb64> a, Span<const Aabb64> b, PairSink sink, Span<const Filter> filters_a = {},
                     Span<const Filter> filters_b = {});

  /// Bytes of scratch held at the moment.
  std::size_t scratch_bytes() const;

 private:
  struct BOXSTREAM_LOCAL Impl;
  std::unique_ptr<Impl> impl_;
};

/// One-off searches: a Detector made, used and dropped.
BOXSTREAM_API std::vector<Pair> find_pairs(Span<const Aabb> boxes);
BOXSTREAM_API std::vector<Pair> find_pairs(Span<const Aabb64> boxes);
BOXSTREAM_API std::vector<Pair> find_pairs(Span<const Aabb> a, Span<const Aabb> b);
BOXSTREAM_API std::vector<Pair> find_pairs(Span<const Aabb64> a, Span<const Aabb64> b);

/// Name of the SIMD target that the sweeps run on here ("AVX3", "AVX2", "SSE4", "NEON", "EMU128", ...).
BOXSTREAM_API const char* simd_target();

}  // namespace boxstream
