// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/aabb.hpp>
#include <cstdint>
#include <string>
#include <variant>

#include "formats/record/pair_digest.hpp"

namespace boxstream::record {

// One call to a broad-phase, as a stream holds it. Proxies go by their number of creation: 0, 1, 2 ... , never used
// again. Coordinates of either precision are held in double, exactly. docs/bsrec.md has the meaning of each in bytes.

enum class Scalar : std::uint8_t { float32 = 4, float64 = 8 };

struct Header {
  Scalar scalar = Scalar::float32;
  /// Where things are expected to stay, for broad-phases that need it. Rounded to the precision of the stream.
  Aabb64 bounds{{-1000, -1000, -1000}, {1000, 1000, 1000}};
  /// Where the stream comes from, as text: at most `max_about` bytes.
  std::string about;

  static constexpr std::size_t max_about = 1000;
  /// What a reader takes for bounds: within these no arithmetic on them overflows.
  static constexpr double max_bound = 1e30, min_side = 1e-6;
};

struct Create {
  std::uint32_t id;  // the number of creations before this one
  std::int32_t shape;
  std::int32_t group;
  std::int32_t mask;
  Aabb64 box;
};
struct Move {
  std::uint32_t id;
  Aabb64 box;
};
struct Destroy {
  std::uint32_t id;
};
struct Refilter {
  std::uint32_t id;
  std::int32_t group;
  std::int32_t mask;
};
struct BoxQuery {
  Aabb64 box;
};
struct RayQuery {
  double from[3];
  double to[3];
  double inverse_direction[3];
  double length;
  double extent_min[3];
  double extent_max[3];
};
/// calculateOverlappingPairs, and the pairs held after it whose boxes overlap.
struct Batch {
  PairDigest pairs;
};
struct ResetPool {};

using Op = std::variant<Create, Move, Destroy, Refilter, BoxQuery, RayQuery, Batch, ResetPool>;

// Streams as text. Numbers are the shortest that give the same bits in the precision of the stream.

std::string text_of(const Aabb64& box, Scalar scalar);
/// One line without its end. Batches and box queries are not numbered.
std::string text_of(const Op& op, Scalar scalar);
/// One line without its end; control characters are replaced.
std::string text_of(const Header& header);

}  // namespace boxstream::record
