// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/span.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/record/player.hpp"
#include "formats/record/reader.hpp"

namespace boxstream::record {

/// Counts of each kind of operation in a stream.
struct Census {
  std::uint64_t created = 0, moves = 0, destroyed = 0, refilters = 0, box_queries = 0, ray_queries = 0, batches = 0;
  std::uint64_t resets = 0;
  std::uint64_t invalid_boxes = 0;  // of creations and moves: a NaN, or min > max
  std::uint64_t most_alive = 0;     // at any one time
};

/// Reads a stream to its end. Throws RecordError: a stream that passes can be replayed without one from a Reader.
Census census_of(Span<const std::uint8_t> bytes, CutOff cut_off = CutOff::is_error);

/// Where the pairs of a broad-phase, or hits of a box query, are not those of the independent search.
struct Difference {
  std::uint64_t batch = 0;  ///< from 1; for a query: the batch that comes next
  std::uint64_t query = 0;  ///< number of the box query, from 1; 0 if it is about the pairs of the batch
  /// The number of pairs (or hits) of each party after a test of the boxes: "recording" (pairs only), the broad-phases,
  /// and "search".
  std::vector<std::pair<std::string, std::uint64_t>> counts;
  std::string party;  ///< differs from the search
  bool missing = false;
  /// The two proxies of the first pair, or the one proxy of the first hit, that `party` lacks (or, if not `missing`,
  /// has and should not have). Empty if it is the recording and more than one pair is different: it holds only a hash.
  std::vector<std::uint32_t> proxies;
  std::vector<Aabb64> boxes;  ///< theirs
};

std::string describe(const Difference& difference, Scalar scalar);

struct ReplayResult {
  std::uint64_t batches = 0;         ///< that were replayed: all, unless there is a difference
  std::uint64_t pairs = 0;           ///< expected, in all of them together
  std::vector<double> milliseconds;  ///< that each broad-phase took for all its calls
  std::optional<Difference> difference;
};

/// Replays a stream on each of `players` and compares, at each batch, their pairs whose boxes overlap, the recorded
/// hash, and the pairs of an independent search; and likewise the hits of box queries, of which nothing is recorded.
/// Hits of rays are not compared: where a ray grazes a box, arithmetic decides. Stops at the first difference.
///
/// `progress` gets the number of batches done, and that of pairs, after each. Throws RecordError, also where more than
/// `most_pairs` are expected at once, before any player is asked for them. Beside pairs, memory is in proportion to the
/// stream.
ReplayResult replay(Span<const std::uint8_t> bytes, const std::vector<std::unique_ptr<Player>>& players,
                    CutOff cut_off = CutOff::is_error,
                    const std::function<void(std::uint64_t, std::uint64_t)>& progress = {},
                    std::uint64_t most_pairs = usual_most_pairs);

}  // namespace boxstream::record
