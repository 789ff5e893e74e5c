// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstdint>
#include <string>

#include <boxstream/aabb.hpp>
#include <boxstream/detail/export.hpp>
#include <boxstream/executor.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/span.hpp>

namespace boxstream {

/// Boxes that need not be in memory: a file, a database, a generator. Read from the first box to the last, more than
/// once, and the same each time.
template <class S>
class BasicBoxReader {
 public:
  virtual ~BasicBoxReader() = default;

  /// The next `read` begins with the first box.
  virtual void rewind() = 0;
  /// The next boxes, any number of them; none after the last one. Valid until the next call of either. May throw.
  virtual Span<const BasicAabb<S>> read() = 0;
};

using BoxReader = BasicBoxReader<float>;
using BoxReader64 = BasicBoxReader<double>;

/// Numbers of two boxes that overlap, counted from 0 in the order of the reader; a < b.
struct WidePair {
  std::uint64_t a, b;

  friend constexpr bool operator==(WidePair x, WidePair y) { return x.a == y.a && x.b == y.b; }
  friend constexpr bool operator<(WidePair x, WidePair y) { return x.a != y.a ? x.a < y.a : x.b < y.b; }
};

/// Receives pairs in batches (never empty; valid during the call only) and returns false to stop the search.
/// Runs on the calling thread; may throw, and the exception passes through.
using WidePairSink = FunctionRef<bool(Span<const WidePair>)>;

struct OutOfCoreOptions {
  /// Bytes to work in, at least 64 KiB; what the reader takes comes on top. Boxes that fit, about one for each 400
  /// bytes, are searched at once, without a file.
  std::uint64_t memory = std::uint64_t{1} << 30;
  /// Where the temporary file is; empty: the folder that TMPDIR, TMP, TEMP or TEMPDIR names, or /tmp.
  std::string directory = {};
  /// As in DetectorOptions. Not used below 64 MiB of memory: threads hold back pairs. From there on 18 MiB are for
  /// these, with an executor or without.
  Executor* executor = nullptr;
  /// As in PairRules.
  bool touching = true;
  double tolerance = 0;
};

struct OutOfCoreStats {
  std::uint64_t boxes = 0;          ///< of the reader, as far as it was read
  std::uint64_t invalid = 0;        ///< of these, boxes with a NaN or min > max, which pair with nothing
  std::uint64_t pairs = 0;          ///< passed to the sink
  std::uint64_t boxes_read = 0;     ///< from the reader, all passes together
  std::uint64_t searches = 0;       ///< in memory
  std::uint64_t copies = 0;         ///< boxes written to the temporary file
  std::uint64_t bytes_written = 0;  ///< to it
  std::uint64_t bytes_read = 0;     ///< from it
  std::uint64_t file_bytes = 0;     ///< its size at the end
};

/// Passes every pair of boxes that overlap or touch, or of what the options say, to `sink`, each exactly once, and
/// nothing else, for sets that are larger than memory.
///
/// @par Order
/// A function of the boxes and of `memory`; the same for any executor.
///
/// @par Cost
/// Boxes that fit in memory are read once. Others are read twice: to draw a sample, and to write each to the regions of
/// space that it touches, which are then read and searched one by one. Regions that do not fit are divided again. Where
/// boxes cannot be separated, blocks of them are searched with each other, all with all; then what is read grows with
/// the square of their number, as their pairs do, unless they are long: of long bars, copies grow with the square root
/// of n over the boxes that fit.
///
/// @par Files
/// One, written and read in blocks, for this process alone: it has no name, its mode is 0600, and programs that are
/// started do not inherit it. So it is gone however the program ends. Where the file system makes no file without a
/// name, it has one until it is open. On Windows it has one, cannot be opened by it, and is removed on return.
///
/// @par Memory
/// At most `options.memory`, and 8 bytes for each block of the file, which has 4 KiB to 1 MiB. Up to three times as
/// much where a search has to copy boxes to many cells: long bars that cross heaps of thousands in one place.
///
/// @par Floating point
/// Any environment: nothing is computed in it, and reader and sink are called in the caller's.
///
/// @par Errors
/// std::invalid_argument (memory, tolerance), std::system_error (the file, with the system's reason: no folder, disk
/// full), std::bad_alloc, and what reader and sink throw. Nothing is left then, and no memory is taken to give up.
///
/// Filters, ids and two sets are not offered.
BOXSTREAM_API OutOfCoreStats stream_pairs(BoxReader& boxes, WidePairSink sink, const OutOfCoreOptions& options = {});
BOXSTREAM_API OutOfCoreStats stream_pairs(BoxReader64& boxes, WidePairSink sink, const OutOfCoreOptions& options = {});

}  // namespace boxstream
